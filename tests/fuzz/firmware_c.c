/* Reads inputs by the C example's own JSON and recording.json, one after the other.
 *
 * An input comes on stdin: its length as four bytes, the lowest first, then its bytes. Each is
 * answered by one byte, after all values in it have been walked through, and the file at argv[1],
 * which holds the same bytes, has been read as a recording. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "recording.h"

enum { MOST_CUTS = 512 };

static void walk(struct json value)
{
    static const char *const keys[] = {"channels", "name", "setup", "file", "seq", ""};
    struct json inner = {NULL, NULL};
    char text[40];
    double number;
    (void)json_text(value, text, sizeof text);
    (void)json_text(value, text, 1);
    (void)json_number(value, &number);
    if (json_is_array(value))
        while (json_item(value, &inner))
            walk(inner);
    if (json_is_object(value))
        for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
            if (json_member(value, keys[i], &inner))
                walk(inner);
}

static void read_value(const char *data, size_t length)
{
    /* As large as the text is, so that the sanitizer sees a byte read behind it. */
    char *text = malloc(length + 1);
    struct json value;
    if (text == NULL)
        exit(2);
    memcpy(text, data, length);
    text[length] = '\0';
    if (json_parse(text, length, &value))
        walk(value);
    free(text);
}

/* What has been read is finite, and every text ends within its place. */
static void read_recording(const char *path)
{
    static struct recording recording;
    struct failure failure = {""};
    if (!recording_read(&recording, path, &failure)) {
        if (failure.text[0] == '\0' || strlen(failure.text) >= sizeof failure.text)
            abort();
        return;
    }
    for (int i = 0; i < recording.entries; i++)
        if (memchr(recording.entry[i].file, '\0', FILE_SIZE) == NULL)
            abort();
    for (int i = 0; i < recording.tracks; i++)
        (void)recording_find(&recording, HEIGHT, recording.track[i]);
}

int main(int count, char **arguments)
{
    unsigned char head[4];
    if (count != 2)
        return 2;
    while (fread(head, 1, 4, stdin) == 4) {
        size_t length = head[0] | (size_t)head[1] << 8 | (size_t)head[2] << 16;
        char *data = malloc(length + 1);
        if (data == NULL || fread(data, 1, length, stdin) != length)
            return 2;
        read_value(data, length);
        /* A text that is cut reads on behind its end, if anything does. */
        for (size_t cut = 0; cut < length && cut < MOST_CUTS; cut++)
            read_value(data, cut);
        read_recording(arguments[1]);
        free(data);
        putchar('.');
        fflush(stdout);
    }
    return 0;
}
