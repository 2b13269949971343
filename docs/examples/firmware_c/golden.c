/* Replay the golden vectors of a folder and print which stages pass: golden FOLDER */
#define _POSIX_C_SOURCE 200112L

#include <dirent.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "replay.h"

enum { MOST_FILES = 200, LONGEST_NAME = 256, LARGEST_BYTES = 1 << 20 };

static const char *const PRECISION = sizeof(fr_real) == sizeof(double) ? "float64" : "float32";

static int by_name(const void *a, const void *b)
{
    return strcmp(a, b);
}

/* The names of the .json files of a folder, sorted; -1 if it cannot be read. */
static int list(const char *folder, char names[][LONGEST_NAME])
{
    int count = 0;
    DIR *directory = opendir(folder);
    struct dirent *entry;
    if (directory == NULL)
        return -1;
    while ((entry = readdir(directory)) != NULL) {
        size_t length = strlen(entry->d_name);
        if (length > 5 && length < LONGEST_NAME && count < MOST_FILES &&
            strcmp(entry->d_name + length - 5, ".json") == 0)
            strcpy(names[count++], entry->d_name);
    }
    closedir(directory);
    qsort(names, (size_t)count, LONGEST_NAME, by_name);
    return count;
}

static bool read_vector(const char *folder, const char *name, struct json *document)
{
    static char text[LARGEST_BYTES + 1];
    char path[2 * LONGEST_NAME];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return false;
    size_t length = fread(text, 1, LARGEST_BYTES, file);
    fclose(file);
    text[length] = '\0';
    return json_parse(text, length, document) && json_is_object(*document);
}

static bool number_of(struct json object, const char *group, const char *key, double *number)
{
    struct json value;
    return json_member(object, group, &value) && json_member(value, key, &value) &&
           json_number(value, number);
}

/* Read the signals called `names`. */
static bool read_signals(struct json document, const char *group, const char *const *names,
                         struct signals *signals)
{
    memset(signals, 0, sizeof *signals);
    for (int i = 0; i < MOST_SIGNALS && names[i] != NULL; i++) {
        struct json array, item = {NULL, NULL};
        if (!json_member(document, group, &array) || !json_member(array, names[i], &array))
            return false;
        while (json_item(array, &item)) {
            if (signals->count[i] == MOST_SAMPLES ||
                !json_number(item, &signals->samples[i][signals->count[i]++]))
                return false;
        }
    }
    return true;
}

/* The largest error, relative to the largest magnitude of its output; infinite if the number of
   samples differs or one is NaN. */
static double worst_error(const struct signals *made, const struct signals *expected)
{
    double worst = 0.0;
    for (int i = 0; i < MOST_SIGNALS; i++) {
        double largest = 0.0, error = 0.0;
        if (made->count[i] != expected->count[i])
            return INFINITY;
        for (int k = 0; k < expected->count[i]; k++) {
            double apart = fabs(made->samples[i][k] - expected->samples[i][k]);
            largest = fmax(largest, fabs(expected->samples[i][k]));
            error = isnan(apart) ? INFINITY : fmax(error, apart);
        }
        if (expected->count[i] > 0)
            worst = fmax(worst, error / largest);
    }
    return worst;
}

/* Print one line for the vector; false if its stage fails. */
static bool replay(const char *name, struct json document, const struct stage *stage)
{
    static struct signals in, made, expected;
    double settings[MOST_SETTINGS] = {0.0}, tolerance, error;
    bool read = read_signals(document, "inputs", stage->inputs, &in) &&
                read_signals(document, "outputs", stage->outputs, &expected) &&
                number_of(document, "tolerance", PRECISION, &tolerance);
    for (int i = 0; i < MOST_SETTINGS && stage->settings[i] != NULL; i++)
        read = read && number_of(document, "settings", stage->settings[i], &settings[i]);
    if (!read) {
        printf("FAIL  %-36s a setting or a signal is missing\n", name);
        return false;
    }
    memset(&made, 0, sizeof made);
    fr_status status = stage->apply(settings, &in, &made);
    if (status != FR_OK) {
        printf("FAIL  %-36s %s\n", name, fr_status_text(status));
        return false;
    }
    error = worst_error(&made, &expected);
    printf("%s  %-36s error %.1e, tolerance %.0e (%s)\n", error <= tolerance ? "pass" : "FAIL",
           name, error, tolerance, PRECISION);
    return error <= tolerance;
}

static const struct stage *stage_of(struct json document)
{
    char name[64] = "";
    struct json value;
    if (json_member(document, "stage", &value))
        json_text(value, name, sizeof name);
    return stage_named(name);
}

int main(int argc, char **argv)
{
    static char names[MOST_FILES][LONGEST_NAME];
    int count = argc == 2 ? list(argv[1], names) : -1, passed = 0, failed = 0, others = 0;
    if (count < 0) {
        fprintf(stderr, "usage: golden FOLDER, one that `conformance export` has filled\n");
        return 2;
    }
    for (int i = 0; i < count; i++) {
        struct json document;
        const struct stage *stage = NULL;
        if (!read_vector(argv[1], names[i], &document)) {
            printf("FAIL  %-36s is not a JSON object\n", names[i]);
            failed++;
        } else if ((stage = stage_of(document)) == NULL) {
            others++;
        } else if (replay(names[i], document, stage)) {
            passed++;
        } else {
            failed++;
        }
    }
    printf("%d passed, %d failed, %d of stages that it does not replay\n", passed, failed,
           others);
    return failed == 0 && passed > 0 ? 0 : 1;
}
