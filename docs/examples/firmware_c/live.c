/* The firmware as a device of the judge that also streams: messages in, points out. */
#include "live.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "protocol.h"
#include "run.h"

static struct stream stream;

bool refuse(const char *text)
{
    printf("{\"kind\": \"refused\", \"text\": \"%s\"}\n", text);
    return false;
}

static void read_channel(struct json channel)
{
    struct json value;
    char name[LONGEST_NAME] = "", track[LONGEST_NAME / 2];
    struct wheel_path *path = &stream.paths[stream.path_count];
    if (json_member(channel, "name", &value))
        json_text(value, name, sizeof name);
    if (json_member(channel, "rate_hz", &value))
        json_number(value, &stream.rate_hz);
    if (strcmp(name, "height") != 0 || stream.path_count == MOST_PATHS ||
        !json_member(channel, "track", &value) || !json_text(value, track, sizeof track))
        return;
    strcpy(path->name, track);
    snprintf(path->height.name, LONGEST_NAME, "%s.height", track);
    snprintf(path->force.name, LONGEST_NAME, "%s.vertical_specific_force", track);
    stream.path_count++;
}

static bool hello(struct json message)
{
    struct json setup, value, channels, channel = {NULL, NULL};
    strcpy(stream.distance.name, "distance");
    if (!json_member(message, "setup", &setup) || !json_member(setup, "profile_interval_m", &value) ||
        !json_number(value, &stream.interval_m) || !json_member(message, "channels", &channels))
        return refuse("hello without setup.profile_interval_m or without channels");
    while (json_item(channels, &channel))
        read_channel(channel);
    if (!live_begin(&stream))
        return false;
    printf("{\"kind\": \"started\", \"format\": \"floatref-live/1\", \"latency\": "
           "{\"travelled_m\": 0, \"then_s\": 0.5, \"longest_s\": 0.5}}\n");
    return true;
}

static bool enqueue(struct queue *queue, struct json channels)
{
    struct json part, values, item = {NULL, NULL};
    if (!json_member(channels, queue->name, &part) || !json_member(part, "values", &values))
        return true;
    while (json_item(values, &item)) {
        double value;
        if (queue->count == WAITING)
            return refuse("a channel is too far ahead of another");
        queue->values[queue->count++] = json_number(item, &value) ? (fr_real)value : (fr_real)NAN;
    }
    return true;
}

static bool samples(struct json message)
{
    struct json channels;
    if (!json_member(message, "channels", &channels))
        return refuse("samples without channels");
    bool taken = enqueue(&stream.distance, channels);
    for (size_t i = 0; taken && i < stream.path_count; i++)
        taken = enqueue(&stream.paths[i].force, channels) &&
                enqueue(&stream.paths[i].height, channels);
    return taken && live_process(&stream);
}

static bool synced(struct json message)
{
    struct json number;
    if (!json_member(message, "number", &number))
        return refuse("sync without a number");
    printf("{\"kind\": \"synced\", \"number\": %.*s}\n", (int)(number.end - number.begin), number.begin);
    return true;
}

/* Answer one message of a stream; false if it was the last one. */
static bool follow(struct json message)
{
    struct json value;
    char kind[16] = "";
    if (json_member(message, "kind", &value))
        json_text(value, kind, sizeof kind);
    if (strcmp(kind, "hello") == 0)
        return hello(message);
    if (strcmp(kind, "samples") == 0)
        return samples(message);
    if (strcmp(kind, "sync") == 0)
        return synced(message);
    if (strcmp(kind, "finish") == 0)
        printf("{\"kind\": \"finished\"}\n");
    else
        refuse("kind is not hello, samples, sync or finish");
    return false;
}

int main(void)
{
    struct device device = {"firmware_c_live", "2.0", "temporal", run, NULL, follow};
    return serve(&device);
}
