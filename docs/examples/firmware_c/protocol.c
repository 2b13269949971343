#include "protocol.h"

#include <stdio.h>
#include <string.h>

#include "json.h"

enum { LONGEST_LINE = 1 << 20, LONGEST_PATH = 1000 };

/* Read a line without its end; -1 at the end of the input, LONGEST_LINE if it is longer. */
static long read_line(char *line)
{
    long length = 0;
    int c;
    while ((c = getchar()) != EOF && c != '\n')
        if (length < LONGEST_LINE)
            line[length++] = (char)c;
    line[length < LONGEST_LINE ? length : LONGEST_LINE - 1] = '\0';
    return c == EOF && length == 0 ? -1 : length;
}

/* Begin an answer with the request's number, if it has one. */
static void answer(struct json request)
{
    struct json seq;
    double number;
    printf("{");
    if (request.begin != NULL && json_is_object(request) && json_member(request, "seq", &seq) &&
        json_number(seq, &number))
        printf("\"seq\": %.*s, ", (int)(seq.end - seq.begin), seq.begin);
}

static void answer_text(struct json request, const char *key, const char *text)
{
    answer(request);
    printf("\"%s\": ", key);
    json_write_text(stdout, text);
    printf("}\n");
}

static void answer_start(const struct device *device, struct json request)
{
    struct json value;
    double version = 0.0;
    if (!json_member(request, "version", &value) || !json_number(value, &version) || version != 1.0) {
        answer_text(request, "error", "this device speaks version 1 of the protocol");
        return;
    }
    answer(request);
    printf("\"version\": 1, \"device\": {\"name\": ");
    json_write_text(stdout, device->name);
    printf(", \"version\": ");
    json_write_text(stdout, device->version);
    printf(", \"architecture\": ");
    json_write_text(stdout, device->architecture);
    printf(", \"capabilities\": []%s}}\n", device->stream != NULL ? ", \"streaming\": true" : "");
}

static void answer_run(const struct device *device, struct json request)
{
    char recording[LONGEST_PATH], profile[LONGEST_PATH];
    struct json value;
    struct failure failure = {""};
    if (!json_member(request, "recording", &value) ||
        !json_text(value, recording, sizeof recording) ||
        !json_member(request, "profile", &value) || !json_text(value, profile, sizeof profile)) {
        answer_text(request, "error", "run: recording and profile have to be paths");
    } else if (device->skips != NULL) {
        answer_text(request, "skipped", device->skips);
    } else if (device->run(recording, profile, &failure)) {
        answer(request);
        printf("\"ok\": true}\n");
    } else {
        answer_text(request, "error", failure.text);
    }
}

/* Answer one request; false if it was the last one. */
static bool obey(const struct device *device, struct json request)
{
    char command[16] = "";
    struct json value;
    if (device->stream != NULL && json_is_object(request) && json_member(request, "kind", &value))
        return device->stream(request);
    if (json_is_object(request) && json_member(request, "cmd", &value))
        json_text(value, command, sizeof command);
    if (strcmp(command, "stop") == 0)
        return false;
    if (strcmp(command, "start") == 0)
        answer_start(device, request);
    else if (strcmp(command, "run") == 0)
        answer_run(device, request);
    else
        answer_text(request, "error", "cmd is not start, run or stop");
    return true;
}

int serve(const struct device *device)
{
    static char line[LONGEST_LINE];
    long length;
    while ((length = read_line(line)) >= 0) {
        struct json request = {NULL, NULL}, nothing = {NULL, NULL};
        if (length >= LONGEST_LINE)
            answer_text(nothing, "error", "a line is longer than 1 MiB");
        else if (!json_parse(line, (size_t)length, &request))
            answer_text(nothing, "error", "a line is not JSON");
        else if (!obey(device, request))
            return 0;
        if (fflush(stdout) != 0)
            return 1;
    }
    return 0;
}
