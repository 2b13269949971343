/* The wheel paths of a stream: a forward pass alone, so each point is final at once. */
#include "live.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"

static const double COUNTS_OF_INTERVAL = 16777216.0; /* a float64 distance as counts */
static const double SLOWEST_MPS = 4.4704, SETTLED_M = 105.91;

bool live_begin(struct stream *stream)
{
    fr_adaptive_config config = fr_adaptive_defaults();
    config.travel.rate_hz = stream->rate_hz;
    config.travel.metres_per_count = stream->interval_m / COUNTS_OF_INTERVAL;
    config.travel.back = FR_BACK_TAKEN;
    config.interval_m = stream->interval_m;
    config.gravity_mps2 = 9.80665;
    config.missing = FR_MISSING_BRIDGED;
    for (size_t i = 0; i < stream->path_count; i++) {
        size_t size = fr_adaptive_size(&config);
        if (fr_adaptive_init(malloc(size), size, &config, &stream->paths[i].stage) != FR_OK)
            return refuse("the rate or the profile interval cannot be");
    }
    return stream->path_count > 0 || refuse("no channel height of a track");
}

static void dequeue(struct queue *queue, size_t n)
{
    queue->count -= n;
    memmove(queue->values, queue->values + n, queue->count * sizeof *queue->values);
}

static void write_number(double value)
{
    if (isnan(value))
        printf("null");
    else
        printf("%.17g", value);
}

/* Write `n` points; one is valid above 16 km/h, and behind the wavelength that the filter needs. */
static void give(struct stream *stream, size_t n)
{
    printf("{\"kind\": \"points\", \"state\": \"final\", \"first\": %ld, \"interval_m\": %.17g, "
           "\"pipeline\": \"\", \"tracks\": {", stream->first, stream->interval_m);
    for (size_t i = 0; i < stream->path_count; i++) {
        const struct wheel_path *path = &stream->paths[i];
        printf("%s", i == 0 ? "" : ", ");
        json_write_text(stdout, path->name);
        printf(": {\"elevation\": [");
        for (size_t k = 0; k < n; k++) {
            printf("%s", k == 0 ? "" : ", ");
            write_number(path->elevation[k]);
        }
        printf("], \"valid\": [");
        for (size_t k = 0; k < n; k++) {
            double at_m = (double)(stream->first + (long)k) * stream->interval_m;
            bool valid = path->speed[k] > SLOWEST_MPS && at_m > stream->start_m + SETTLED_M;
            printf("%s%s", k == 0 ? "" : ", ", valid ? "true" : "false");
        }
        printf("]}");
    }
    printf("}}\n");
    stream->first += (long)n;
}

/* The distance of the first sample: points are counted from the one nearest to it. */
static void begin_distance(struct stream *stream)
{
    double at_m = stream->distance.values[0];
    stream->first = isnan(at_m) ? 0 : lrint(at_m / stream->interval_m);
    stream->start_m = (double)stream->first * stream->interval_m;
    stream->begun = true;
}

static bool process_chunk(struct stream *stream, size_t n)
{
    int64_t counts[CHUNK_OF_STREAM];
    size_t made = 0;
    if (!stream->begun)
        begin_distance(stream);
    for (size_t k = 0; k < n; k++) {
        double intervals = (stream->distance.values[k] - stream->start_m) / stream->interval_m;
        counts[k] = isnan(intervals) ? FR_NO_COUNT : (int64_t)rint(intervals * COUNTS_OF_INTERVAL);
    }
    for (size_t i = 0; i < stream->path_count; i++) {
        struct wheel_path *path = &stream->paths[i];
        fr_status status = fr_adaptive_push(path->stage, path->force.values, path->height.values, counts,
                                            n, path->elevation, path->speed, POINTS, &made);
        if (status != FR_OK)
            return refuse(fr_status_text(status));
        dequeue(&path->force, n);
        dequeue(&path->height, n);
    }
    dequeue(&stream->distance, n);
    if (made > 0)
        give(stream, made);
    return true;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

bool live_process(struct stream *stream)
{
    for (;;) {
        size_t n = least(stream->distance.count, CHUNK_OF_STREAM);
        for (size_t i = 0; i < stream->path_count; i++)
            n = least(n, least(stream->paths[i].force.count, stream->paths[i].height.count));
        if (n == 0)
            return true;
        if (!process_chunk(stream, n))
            return false;
    }
}
