#include "window.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { BYTES = 8 };

/* Files are little-endian on every processor. */
static double decoded(const unsigned char *bytes)
{
    uint64_t bits = 0;
    double value;
    for (int i = BYTES - 1; i >= 0; i--)
        bits = bits << 8 | bytes[i];
    memcpy(&value, &bits, sizeof value);
    return value;
}

bool window_open(struct window *window, const char *folder, const char *name,
                 struct failure *failure)
{
    char path[2 * FILE_SIZE];
    long size = -1;
    snprintf(path, sizeof path, "%s%s", folder, name);
    memset(window, 0, sizeof *window);
    window->file = fopen(path, "rb");
    if (window->file == NULL)
        return fail(failure, "%s: cannot be opened", name);
    if (fseek(window->file, 0, SEEK_END) == 0)
        size = ftell(window->file);
    if (size <= 0 || size % BYTES != 0)
        return fail(failure, "%s: holds no whole number of float64 samples", name);
    window->count = size / BYTES;
    return true;
}

void window_close(struct window *window)
{
    if (window->file != NULL)
        fclose(window->file);
    window->file = NULL;
}

double window_at(struct window *window, long index)
{
    if (index < window->first || index >= window->first + window->held) {
        static unsigned char bytes[BYTES * WINDOW];
        size_t held = 0;
        if (fseek(window->file, BYTES * index, SEEK_SET) == 0)
            held = fread(bytes, BYTES, WINDOW, window->file);
        for (size_t i = 0; i < held; i++)
            window->samples[i] = decoded(bytes + BYTES * i);
        window->first = index;
        window->held = (long)held;
    }
    return window->held > 0 ? window->samples[index - window->first] : NAN;
}
