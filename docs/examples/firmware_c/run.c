#include "run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "profile.h"
#include "search.h"
#include "setup.h"
#include "window.h"

static const double SLOWEST_HZ = 20.0; /* of an accelerometer */
static const double MOST_POINTS = 5e7, TIE = 1e-6;
static const double COUNTS_OF_INTERVAL = 16777216.0; /* a float64 distance as counts */

enum { MISSING = FR_CAUSE_MISSING, DRIFT = FR_CAUSE_DRIFT, SLOW = FR_CAUSE_SLOW };

/* A wheel path with its two sensors. */
struct wheel_path {
    struct channel force, height;
    struct path path;
};

struct session {
    struct recording recording;
    struct channel distance;
    struct wheel_path *paths;
    struct vehicle vehicle;
    struct clock clock; /* of the first accelerometer, without its holes */
    double metres_per_count, start_m;
    long first, last;   /* the samples of the clock that all channels cover */
};

static bool open_channel(struct session *session, struct channel *channel, enum quantity quantity,
                         const char *track, struct failure *failure)
{
    const struct entry *entry = recording_find(&session->recording, quantity, track);
    if (entry == NULL)
        return fail(failure, "channel %s of track %s: missing", QUANTITY_NAMES[quantity], track);
    return channel_open(channel, &session->recording, entry, failure);
}

static bool open_channels(struct session *session, struct failure *failure)
{
    const struct recording *recording = &session->recording;
    session->paths = calloc((size_t)recording->tracks, sizeof *session->paths);
    if (session->paths == NULL)
        return fail(failure, "out of memory");
    if (!open_channel(session, &session->distance, DISTANCE, recording->track[0], failure))
        return false;
    for (int i = 0; i < recording->tracks; i++)
        if (!open_channel(session, &session->paths[i].force, VERTICAL_SPECIFIC_FORCE,
                          recording->track[i], failure) ||
            !open_channel(session, &session->paths[i].height, HEIGHT, recording->track[i], failure))
            return false;
    return channel_steady(&session->paths[0].force, &session->clock, failure);
}

/* Search all channels for samples that measure nothing. */
static bool search_all(struct session *session, struct failure *failure)
{
    struct channel *distance = &session->distance;
    double count_m = session->metres_per_count = session->recording.interval_m / COUNTS_OF_INTERVAL;
    bool done = search(distance, DISTANCE, distance, NULL, count_m, failure);
    for (int i = 0; done && i < session->recording.tracks; i++) {
        struct wheel_path *path = &session->paths[i];
        done = search(&path->force, VERTICAL_SPECIFIC_FORCE, distance, NULL, count_m, failure) &&
               search(&path->height, HEIGHT, distance, &path->force, count_m, failure);
    }
    return done;
}

/* Channel `i` of all: the distance, then force and height of each wheel path; NULL behind them. */
static struct channel *channel_of(struct session *session, int i)
{
    if (i == 0)
        return &session->distance;
    if (i > 2 * session->recording.tracks)
        return NULL;
    struct wheel_path *path = &session->paths[(i - 1) / 2];
    return i % 2 == 1 ? &path->force : &path->height;
}

/* Align the channels with the first accelerometer and find the samples that all cover. */
static bool align(struct session *session, struct failure *failure)
{
    const struct clock *clock = &session->clock;
    struct channel *channel;
    double begin = -INFINITY, end = INFINITY;
    for (int i = 0; (channel = channel_of(session, i)) != NULL; i++) {
        channel_align(channel, clock);
        begin = fmax(begin, channel_time(channel, 0));
        end = fmin(end, channel_time(channel, channel->values.count - 1));
    }
    /* A thousandth of a sample: start times are rounded decimals. */
    double first = ceil((begin - clock->start_s) * clock->rate_hz - 1e-3);
    double last = floor((end - clock->start_s) * clock->rate_hz + 1e-3);
    first = fmax(first, 0.0);
    if (!(last > first))
        return fail(failure, "the channels have no stretch of time in common; check start_s");
    session->first = (long)first;
    session->last = (long)last;
    return true;
}

static double time_of(const struct session *session, long index)
{
    return session->clock.start_s + (double)index / session->clock.rate_hz;
}

/* The farthest distance; the last samples may be missing. */
static double length_of(struct session *session)
{
    double farthest = session->start_m;
    for (long i = 0; i < session->distance.values.count; i++)
        farthest = fmax(farthest, window_at(&session->distance.values, i));
    return farthest - session->start_m;
}

/* The first sample whose distance is known, and memory for the points behind it. */
static bool begin_paths(struct session *session, struct failure *failure)
{
    double interval_m = session->recording.interval_m, start_m = NAN;
    for (; session->first < session->last; session->first++) {
        start_m = channel_read(&session->distance, session->first, time_of(session, session->first)).value;
        if (!isnan(start_m))
            break;
    }
    session->start_m = start_m;
    double length_m = length_of(session);
    if (!(length_m >= interval_m))
        return fail(failure, "channel distance: %g m are less than the profile interval", length_m);
    if (length_m > MOST_POINTS * interval_m)
        return fail(failure, "channel distance: %g m are too many points", length_m);
    place_vehicle(&session->vehicle, &session->recording);
    session->vehicle.samples = (size_t)(session->last - session->first + 1);
    for (int i = 0; i < session->recording.tracks; i++) {
        struct path *path = &session->paths[i].path;
        path->vehicle = &session->vehicle;
        path->number = i;
        path->lever_m = session->recording.lever_m[i];
        path->rate_hz = session->clock.rate_hz;
        path->interval_m = interval_m;
        path->metres_per_count = session->metres_per_count;
        path->room = (size_t)(length_m / interval_m + 2 * TIE) + 1;
        path->elevation = run_memory(path->room * sizeof *path->elevation);
        path->speed = run_memory(path->room * sizeof *path->speed);
        path->valid = run_memory(path->room);
        if (path->elevation == NULL || path->speed == NULL || path->valid == NULL)
            return fail(failure, "out of memory for %g m", length_m);
        fr_status status = begin(path);
        if (status != FR_OK)
            return fail(failure, "track %s: %s", session->recording.track[i], fr_status_text(status));
    }
    return true;
}

static uint8_t causes_of(struct reading reading, unsigned lost)
{
    return (uint8_t)((reading.missing ? MISSING : 0u) | (reading.lost ? lost : 0u));
}

/* Read a sample of the encoder, as counts from the beginning. */
static int64_t count_of(struct session *session, long index, uint8_t *causes)
{
    struct reading distance = channel_read(&session->distance, index, time_of(session, index));
    *causes = causes_of(distance, SLOW);
    if (isnan(distance.value))
        return FR_NO_COUNT;
    return (int64_t)rint((distance.value - session->start_m) / session->metres_per_count);
}

/* Give a chunk of all wheel paths to the firmware. */
static bool process_chunk(struct session *session, long first, size_t count, struct failure *failure)
{
    static fr_real force[CHUNK], height[CHUNK];
    static int64_t counts[CHUNK];
    static uint8_t shared[CHUNK], causes[CHUNK];
    for (size_t k = 0; k < count; k++)
        counts[k] = count_of(session, first + (long)k, &shared[k]);
    for (int i = 0; i < session->recording.tracks; i++) {
        struct wheel_path *path = &session->paths[i];
        for (size_t k = 0; k < count; k++) {
            double time = time_of(session, first + (long)k);
            struct reading a = channel_read(&path->force, first + (long)k, time);
            struct reading h = channel_read(&path->height, first + (long)k, time);
            force[k] = (fr_real)a.value;
            height[k] = (fr_real)h.value;
            causes[k] = shared[k] | causes_of(a, DRIFT) | causes_of(h, 0);
            causes[k] |= h.missing ? NO_HEIGHT : 0;
        }
        fr_status status = take(&path->path, force, height, counts, causes, count);
        if (status != FR_OK)
            return fail(failure, "track %s, at %g s: %s", session->recording.track[i],
                        time_of(session, first), fr_status_text(status));
    }
    return true;
}

static bool process(struct session *session, struct failure *failure)
{
    bool done = true;
    for (long i = session->first; done && i <= session->last; i += CHUNK) {
        long count = session->last - i + 1 < CHUNK ? session->last - i + 1 : CHUNK;
        done = process_chunk(session, i, (size_t)count, failure);
    }
    for (int i = 0; done && i < session->recording.tracks; i++) {
        fr_status status = end(&session->paths[i].path);
        done = status == FR_OK ||
               fail(failure, "track %s: %s", session->recording.track[i], fr_status_text(status));
    }
    return done;
}

static bool deliver(struct session *session, const char *profile, struct failure *failure)
{
    const struct path *paths[MOST_TRACKS];
    for (int i = 0; i < session->recording.tracks; i++)
        paths[i] = &session->paths[i].path;
    return profile_write(profile, &session->recording, paths, session->start_m, failure);
}

static void close_session(struct session *session)
{
    struct channel *channel;
    for (int i = 0; session->paths != NULL && (channel = channel_of(session, i)) != NULL; i++)
        channel_close(channel);
    memory_release();
    free(session->paths);
}

static bool check_rate(const struct session *session, struct failure *failure)
{
    double rate_hz = session->clock.rate_hz;
    return (rate_hz >= SLOWEST_HZ && rate_hz <= FASTEST_HZ) ||
           fail(failure, "%g Hz are no rate of an accelerometer", rate_hz);
}

bool run(const char *recording, const char *profile, struct failure *failure)
{
    static struct session session;
    memset(&session, 0, sizeof session);
    bool done = recording_read(&session.recording, recording, failure) &&
                open_channels(&session, failure) && check_rate(&session, failure) &&
                search_all(&session, failure) && align(&session, failure) &&
                begin_paths(&session, failure) && process(&session, failure) &&
                deliver(&session, profile, failure);
    close_session(&session);
    return done;
}
