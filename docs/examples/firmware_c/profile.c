#define _POSIX_C_SOURCE 200112L

#include "profile.h"

#include <errno.h>
#include <stdint.h>
#include <string.h>
#ifdef _WIN32
#include <direct.h>
#define make_folder(path) _mkdir(path)
#else
#include <sys/stat.h>
#define make_folder(path) mkdir(path, 0777)
#endif

#include "json.h"

static FILE *create(const char *folder, const char *name, struct failure *failure)
{
    char path[2 * FILE_SIZE];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        fail(failure, "%s: cannot be written", path);
    return file;
}

static bool finish(FILE *file, const char *name, struct failure *failure)
{
    bool failed = ferror(file) != 0;
    failed = fclose(file) != 0 || failed;
    return !failed || fail(failure, "%s: cannot be written; is the disk full?", name);
}

static void write_double(FILE *file, double value)
{
    uint64_t bits;
    unsigned char bytes[8];
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; i++)
        bytes[i] = (unsigned char)(bits >> 8 * i);
    fwrite(bytes, 1, sizeof bytes, file);
}

static bool write_column(const char *folder, const char *name, const fr_real *x, size_t count,
                         struct failure *failure)
{
    FILE *file = create(folder, name, failure);
    if (file == NULL)
        return false;
    for (size_t k = 0; k < count; k++)
        write_double(file, (double)x[k]);
    return finish(file, name, failure);
}

/* The files of wheel path `i`, named by its number, since a track may have any name. */
static bool write_track(const char *folder, const struct path *path, int i,
                        struct failure *failure)
{
    char name[32];
    snprintf(name, sizeof name, "%d.f64", i);
    if (!write_column(folder, name, path->elevation, path->count, failure))
        return false;
    snprintf(name, sizeof name, "%d.sigma.f64", i);
    if (path->sigma != NULL && !write_column(folder, name, path->sigma, path->count, failure))
        return false;
    snprintf(name, sizeof name, "%d.valid.u8", i);
    FILE *file = create(folder, name, failure);
    if (file == NULL)
        return false;
    fwrite(path->valid, 1, path->count, file);
    return finish(file, name, failure);
}

static void write_settings(FILE *file, const struct path *path)
{
    fr_cut_off_config cut_off = fr_cut_off_defaults();
    fprintf(file, "\"settings\": {\"cutoff_wavelength_m\": %.17g", cut_off.wavelength_m);
    if (!path->through_stops)
        fprintf(file, ", \"low_speed_cutoff_hz\": %.17g, \"transition_speed_mps\": %.17g, "
                      "\"transition_steepness\": %.17g",
                cut_off.low_speed_hz, cut_off.transition_speed_mps, cut_off.steepness_s_per_m);
    fprintf(file, "},\n ");
}

static bool write_document(const char *folder, const struct recording *recording,
                           const struct path *const *paths, double start_m, struct failure *failure)
{
    FILE *file = create(folder, "profile.json", failure);
    if (file == NULL)
        return false;
    fprintf(file, "{\"format\": \"floatref-profile/1\", \"interval_m\": %.17g, ", recording->interval_m);
    fprintf(file, "\"start_m\": %.17g,\n \"pipeline\": \"firmware_c\",\n ", start_m);
    write_settings(file, paths[0]);
    fprintf(file, "\"provenance\": {\"real_bytes\": %d},\n \"tracks\": [", (int)sizeof(fr_real));
    for (int i = 0; i < recording->tracks; i++) {
        fprintf(file, "%s\n  {\"name\": ", i > 0 ? "," : "");
        json_write_text(file, recording->track[i]);
        fprintf(file, ", \"elevation_file\": \"%d.f64\", \"valid_file\": \"%d.valid.u8\"", i, i);
        if (paths[i]->sigma != NULL)
            fprintf(file, ", \"sigma_file\": \"%d.sigma.f64\"", i);
        fprintf(file, "}");
    }
    fprintf(file, "]}\n");
    return finish(file, "profile.json", failure);
}

bool profile_write(const char *path, const struct recording *recording,
                   const struct path *const *paths, double start_m, struct failure *failure)
{
    if (make_folder(path) != 0)
        return fail(failure, "%s: cannot be made: %s", path, strerror(errno));
    for (int i = 0; i < recording->tracks; i++)
        if (!write_track(path, paths[i], i, failure))
            return false;
    return write_document(path, recording, paths, start_m, failure);
}
