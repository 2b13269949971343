#include "recording.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "setup.h"

enum { LARGEST_BYTES = 4 << 20 };
static const double LATEST_S = 1e10;

const char *const QUANTITY_NAMES[QUANTITIES] = {"vertical_specific_force", "height", "distance"};
const double LARGEST[QUANTITIES] = {1e4, 100.0, 1e10};
const double FASTEST_HZ = 1e7;
static const char *const UNITS[QUANTITIES] = {"m/s^2", "m", "m"};

/* The whole file with '\0' at its end; the caller frees it. */
static char *read_text(const char *path, size_t *length, struct failure *failure)
{
    FILE *file = fopen(path, "rb");
    char *text = malloc(LARGEST_BYTES + 1);
    if (file == NULL || text == NULL) {
        fail(failure, "%s: cannot be opened", path);
    } else {
        *length = fread(text, 1, LARGEST_BYTES, file);
        text[*length] = '\0';
        if (ferror(file) || getc(file) != EOF)
            fail(failure, "%s: cannot be read, or is larger than 4 MiB", path);
    }
    if (file != NULL)
        fclose(file);
    if (failure->text[0] == '\0')
        return text;
    free(text);
    return NULL;
}

/* A member that has to be the name of a file in the folder; empty if it is missing. */
static bool read_file_name(struct json entry, const char *key, char *name, struct failure *failure)
{
    struct json value;
    name[0] = '\0';
    if (!json_member(entry, key, &value))
        return true;
    if (!json_text(value, name, FILE_SIZE) || name[0] == '\0' || strpbrk(name, "/\\:") != NULL)
        return fail(failure, "channels: %s is not the plain name of a file", key);
    return true;
}

static bool read_track(struct json entry, char *track, struct failure *failure)
{
    struct json value;
    track[0] = '\0';
    if (!json_member(entry, "track", &value) || *value.begin == 'n')
        return true;
    if (!json_text(value, track, TRACK_SIZE) || track[0] == '\0')
        return fail(failure, "channels: track is not a name of at most 48 characters");
    return true;
}

static bool read_clock(struct json json, struct entry *entry, struct failure *failure)
{
    struct json value;
    const char *name = QUANTITY_NAMES[entry->quantity];
    if (!read_file_name(json, "time_file", entry->time_file, failure))
        return false;
    if (entry->time_file[0] != '\0')
        return true;
    if (!json_member(json, "rate_hz", &value) || !json_number(value, &entry->rate_hz) ||
        !(entry->rate_hz >= 0.001 && entry->rate_hz <= FASTEST_HZ))
        return fail(failure, "channel %s: rate_hz is not between 0.001 and 10000000", name);
    if (!json_member(json, "start_s", &value) || !json_number(value, &entry->start_s) ||
        fabs(entry->start_s) > LATEST_S)
        return fail(failure, "channel %s: start_s is not a number within 1e10 of zero", name);
    return true;
}

static bool read_unit(struct json json, enum quantity quantity, struct failure *failure)
{
    char unit[32] = "";
    struct json value;
    if (json_member(json, "unit", &value) && json_text(value, unit, sizeof unit) &&
        strcmp(unit, UNITS[quantity]) == 0)
        return true;
    return fail(failure, "channel %s: unit '%s', expected '%s'", QUANTITY_NAMES[quantity], unit,
                UNITS[quantity]);
}

static void note_track(struct recording *recording, const char *track)
{
    for (int i = 0; i < recording->tracks; i++)
        if (strcmp(recording->track[i], track) == 0)
            return;
    if (recording->tracks < MOST_TRACKS)
        strcpy(recording->track[recording->tracks++], track);
}

/* Store the channel if it is one of ours; the wheel paths of every channel count. */
static bool read_entry(struct recording *recording, struct json json, struct failure *failure)
{
    char name[64];
    struct json value;
    struct entry *entry = &recording->entry[recording->entries];
    if (!json_is_object(json) || !json_member(json, "name", &value))
        return fail(failure, "channels: an item is not an object with a name");
    if (!read_track(json, entry->track, failure))
        return false;
    if (entry->track[0] != '\0')
        note_track(recording, entry->track);
    if (!json_text(value, name, sizeof name))
        return true;
    for (int i = 0; i < QUANTITIES; i++) {
        if (strcmp(name, QUANTITY_NAMES[i]) != 0)
            continue;
        entry->quantity = (enum quantity)i;
        if (!read_unit(json, entry->quantity, failure) ||
            !read_file_name(json, "file", entry->file, failure) ||
            !read_clock(json, entry, failure))
            return false;
        if (entry->file[0] == '\0')
            return fail(failure, "channel %s: file is missing", name);
        recording->entries++;
    }
    return true;
}

/* Remove the wheel paths without a height. */
static bool keep_profiled(struct recording *recording, struct failure *failure)
{
    int kept = 0;
    if (recording->tracks == 0)
        note_track(recording, "main");
    for (int i = 0; i < recording->tracks; i++)
        if (recording_find(recording, HEIGHT, recording->track[i]) != NULL)
            memmove(recording->track[kept++], recording->track[i], TRACK_SIZE);
    recording->tracks = kept;
    return kept > 0 || fail(failure, "channel height: missing");
}

static bool read_document(struct recording *recording, struct json document,
                          struct failure *failure)
{
    char format[64];
    struct json value, item = {NULL, NULL};
    if (!json_is_object(document) || !json_member(document, "format", &value) ||
        !json_text(value, format, sizeof format) || strcmp(format, "floatref-recording/1") != 0)
        return fail(failure, "format is not floatref-recording/1");
    recording->interval_m = 0.00508;
    if (json_member(document, "setup", &value) && json_is_object(value) &&
        json_member(value, "profile_interval_m", &value))
        if (!json_number(value, &recording->interval_m))
            recording->interval_m = 0.0;
    if (!(recording->interval_m >= 1e-5 && recording->interval_m <= 10.0))
        return fail(failure, "setup.profile_interval_m is not between 0.00001 and 10");
    if (!json_member(document, "channels", &value) || !json_is_array(value))
        return fail(failure, "channels is not a list");
    while (json_item(value, &item)) {
        if (recording->entries == MOST_ENTRIES)
            return fail(failure, "channels: more than %d", MOST_ENTRIES);
        if (!read_entry(recording, item, failure))
            return false;
    }
    return keep_profiled(recording, failure) && setup_read(recording, document, failure);
}

bool recording_read(struct recording *recording, const char *path, struct failure *failure)
{
    size_t length = 0;
    struct json document;
    const char *slash = strrchr(path, '/');
    size_t folder = slash == NULL ? 0 : (size_t)(slash - path) + 1;
    memset(recording, 0, sizeof *recording);
    if (folder >= FILE_SIZE)
        return fail(failure, "the path of the recording is too long");
    memcpy(recording->folder, path, folder);
    char *text = read_text(path, &length, failure);
    if (text == NULL)
        return false;
    bool done = json_parse(text, length, &document)
                    ? read_document(recording, document, failure)
                    : fail(failure, "%s: is not JSON", path);
    free(text);
    return done;
}

const struct entry *recording_find(const struct recording *recording, enum quantity quantity,
                                   const char *track)
{
    const struct entry *shared = NULL;
    for (int i = 0; i < recording->entries; i++) {
        const struct entry *entry = &recording->entry[i];
        if (entry->quantity == quantity && strcmp(entry->track, track) == 0)
            return entry;
        if (entry->quantity == quantity && entry->track[0] == '\0')
            shared = entry;
    }
    return shared;
}
