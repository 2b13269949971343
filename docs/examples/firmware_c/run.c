#include "run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "channel.h"
#include "damage.h"
#include "points.h"
#include "profile.h"
#include "track.h"
#include "validity.h"
#include "window.h"

static const double SLOWEST_HZ = 20.0; /* of an accelerometer */

/* A wheel path with its two sensors. */
struct path {
    struct channel force, height;
    struct track track;
};

struct session {
    struct recording recording;
    struct channel distance;
    struct path *paths;
    struct clock clock; /* of the first accelerometer, without its holes */
    struct drive drive;
    struct points points;
    long first, last; /* the samples of the clock that all channels cover */
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
static bool find_damage(struct session *session, struct failure *failure)
{
    if (!damaged_distance(&session->distance, failure))
        return false;
    for (int i = 0; i < session->recording.tracks; i++) {
        struct path *path = &session->paths[i];
        if (!damaged_force(&path->force, failure) ||
            !damaged_height(&path->height, &path->force, failure))
            return false;
    }
    return true;
}

/* Channel `i` of all: the distance, then force and height of each wheel path; NULL behind them. */
static struct channel *channel_of(struct session *session, int i)
{
    if (i == 0)
        return &session->distance;
    if (i > 2 * session->recording.tracks)
        return NULL;
    struct path *path = &session->paths[(i - 1) / 2];
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

/* The end of the distance; its last samples may be missing. */
static double length_of(struct session *session)
{
    double from = channel_read(&session->distance, session->first,
                               time_of(session, session->first)).value;
    double farthest = from;
    for (long i = 0; i < session->distance.values.count; i++)
        farthest = fmax(farthest, window_at(&session->distance.values, i));
    return farthest - from;
}

static unsigned flags_of(struct reading reading, unsigned lost)
{
    return (reading.missing ? MISSING : 0u) | (reading.lost ? lost : 0u);
}

/* Process every sample by the drive, the wheel paths and the projection. */
static void process(struct session *session)
{
    real elevation[MOST_TRACKS];
    unsigned flags[MOST_TRACKS];
    for (long i = session->first; i <= session->last; i++) {
        double time = time_of(session, i);
        struct reading distance = channel_read(&session->distance, i, time);
        struct sample sample = {drive_step(&session->drive, distance.value), elevation, flags};
        unsigned shared = sample.motion.marks | flags_of(distance, SLOW);
        for (int k = 0; k < session->recording.tracks; k++) {
            struct path *path = &session->paths[k];
            struct reading force = channel_read(&path->force, i, time);
            struct reading height = channel_read(&path->height, i, time);
            elevation[k] = track_step(&path->track, force.value, height.value, sample.motion.c);
            flags[k] = shared | flags_of(force, DRIFT) | flags_of(height, 0);
        }
        points_step(&session->points, &sample);
    }
    points_finish(&session->points);
}

static bool deliver(struct session *session, const char *profile, struct failure *failure)
{
    struct points *points = &session->points;
    for (int i = 0; i < points->tracks; i++) {
        backward_passes(points->elevation[i], points->speed, points->count, points->interval_m);
        trust(points->flags[i], points->count, points->interval_m, &REACH);
    }
    return profile_write(profile, &session->recording, points, failure);
}

static void close_session(struct session *session)
{
    struct channel *channel;
    for (int i = 0; session->paths != NULL && (channel = channel_of(session, i)) != NULL; i++)
        channel_close(channel);
    points_close(&session->points);
    drive_close(&session->drive);
    free(session->paths);
}

bool run(const char *recording, const char *profile, struct failure *failure)
{
    static struct session session;
    memset(&session, 0, sizeof session);
    bool done = recording_read(&session.recording, recording, failure) &&
                open_channels(&session, failure) && find_damage(&session, failure) &&
                align(&session, failure);
    if (done) {
        double rate_hz = session.clock.rate_hz;
        for (int i = 0; i < session.recording.tracks; i++)
            track_open(&session.paths[i].track, rate_hz);
        done = (rate_hz >= SLOWEST_HZ && rate_hz <= FASTEST_HZ) ||
               fail(failure, "%g Hz are no rate of an accelerometer", rate_hz);
        done = done && drive_open(&session.drive, rate_hz, failure) &&
               points_open(&session.points, session.recording.tracks, session.recording.interval_m,
                           length_of(&session), failure);
    }
    if (done) {
        process(&session);
        done = deliver(&session, profile, failure);
    }
    close_session(&session);
    return done;
}
