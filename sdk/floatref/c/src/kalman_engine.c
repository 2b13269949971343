/* SPDX-License-Identifier: Apache-2.0
 *
 * From samples and readings as they come to the filter, in the order of time.
 */
#include <math.h>
#include <string.h>

#include "kalman_engine.h"

/* Counts that are held: the sample that is filtered needs the one a window before. */
static size_t counts_of(uint32_t window, uint32_t delay)
{
    return (size_t)window + delay + 1u;
}

static uint64_t bytes_of(uint32_t window, uint32_t delay, uint32_t readings)
{
    uint64_t counts = (uint64_t)window + delay + 1u;
    return counts * sizeof(int64_t) + (uint64_t)delay * sizeof(fr_kalman_sample) +
           (uint64_t)readings * sizeof(fr_kalman_reading);
}

size_t fr_kalman_engine_room(const fr_kalman_filter_config *config)
{
    if (config == NULL || !fr_kalman_is_possible(config))
        return 0u;
    return fr_sized(0u,
                    bytes_of(fr_travel_window(&config->travel), fr_kalman_delay(config),
                             (uint32_t)config->readings),
                    1u);
}

size_t fr_kalman_engine_bytes(const fr_kalman_engine *engine)
{
    return (size_t)bytes_of(engine->window, engine->delay, engine->room);
}

static fr_kalman_sample *samples_of(const fr_kalman_engine *engine, void *room)
{
    return (fr_kalman_sample *)(void *)((int64_t *)room + counts_of(engine->window, engine->delay));
}

fr_kalman_reading *fr_kalman_readings(const fr_kalman_engine *engine, void *room)
{
    return (fr_kalman_reading *)(void *)(samples_of(engine, room) + engine->delay);
}

void fr_kalman_engine_set(fr_kalman_engine *engine, const fr_kalman_filter_config *config)
{
    fr_kalman_model_set(&engine->model, config);
    fr_kalman_references_set(&engine->references, &engine->model, config);
    fr_kalman_begin(&engine->state, 0.0, config->noise.lean_rad);
    engine->metres_per_count = config->travel.metres_per_count;
    engine->furthest = INT64_MIN;
    engine->window = fr_travel_window(&config->travel);
    engine->duration_s = (double)engine->window / config->travel.rate_hz;
    engine->back = config->travel.back;
    engine->delay = fr_kalman_delay(config);
    engine->room = (uint32_t)config->readings;
    engine->missing = config->missing;
}

/* A missing input is taken as zero, and what was missing is said. */
static int fill(fr_kalman_input *input)
{
    double *all[] = {&input->x, &input->y, &input->z, &input->roll_rate, &input->pitch_rate,
                     &input->yaw_rate};
    int missing = 0;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        int gone = *all[i] != *all[i];
        *all[i] = gone ? 0.0 : *all[i];
        missing |= gone;
    }
    return missing;
}

/* Let go of the first reading. */
static void drop_reading(fr_kalman_engine *engine, fr_kalman_reading *readings)
{
    engine->held--;
    (void)memmove(readings, readings + 1, engine->held * sizeof *readings);
}

static int find_observation(fr_kalman_engine *engine, void *room, double height,
                            fr_kalman_observation *observed)
{
    fr_kalman_reading *readings = fr_kalman_readings(engine, room);
    int64_t at = engine->state.latest;
    double distance_m =
        (double)fr_kalman_engine_count(engine, room, at) * engine->metres_per_count;
    int read = engine->held > 0u && readings[0].at == at;
    double speed = fr_kalman_engine_speed(engine, room, at);
    int seen = fr_kalman_schedule(&engine->references, at, height, speed, distance_m,
                                  read ? readings : NULL, observed);
    if (read != 0)
        drop_reading(engine, readings);
    return seen;
}

int64_t fr_kalman_engine_count(const fr_kalman_engine *engine, const void *room, int64_t at)
{
    const int64_t *ring = (const int64_t *)room;
    int64_t size = (int64_t)counts_of(engine->window, engine->delay);
    return at < 0 ? engine->first : ring[at % size];
}

double fr_kalman_engine_height(const fr_kalman_engine *engine, void *room, int64_t at)
{
    return samples_of(engine, room)[at % (int64_t)engine->delay].height;
}

/* (5.6): before the run the vehicle is stationary. */
double fr_kalman_engine_speed(const fr_kalman_engine *engine, const void *room, int64_t at)
{
    int64_t progress = fr_kalman_engine_count(engine, room, at) -
                       fr_kalman_engine_count(engine, room, at - (int64_t)engine->window);
    return (double)progress * engine->metres_per_count / engine->duration_s;
}

static void filter_sample(fr_kalman_engine *engine, void *room, const fr_kalman_sample *sample,
                          fr_kalman_step *step, fr_kalman_node *node)
{
    fr_kalman_state *state = &engine->state;
    fr_kalman_input input = sample->input;
    int lost = input.z != input.z, seen;
    fr_kalman_observation observed;
    step->missing = fill(&input);
    if (state->started == 0)
        state->x[FR_K_HEIGHT] = sample->height == sample->height ? sample->height : 0.0;
    fr_kalman_advance(&engine->model, state, &input, lost);
    seen = find_observation(engine, room, sample->height, &observed);
    step->is_node = seen || fr_kalman_ends_sub_block(&engine->model, state);
    if (step->is_node != 0)
        fr_kalman_make_node(&engine->model, state, seen ? &observed : NULL, node);
    step->reference_height = state->x[FR_K_HEIGHT];
    step->height = sample->height;
    step->at = state->latest;
    step->count = fr_kalman_engine_count(engine, room, step->at);
}

static void keep_count(fr_kalman_engine *engine, void *room, int64_t count)
{
    int64_t *ring = (int64_t *)room;
    engine->first = engine->pushed == 0 ? count : engine->first;
    ring[engine->pushed % (int64_t)counts_of(engine->window, engine->delay)] = count;
    engine->furthest = count > engine->furthest ? count : engine->furthest;
}

int fr_kalman_engine_take(fr_kalman_engine *engine, void *room, const fr_kalman_sample *sample,
                          int64_t count, fr_kalman_step *step, fr_kalman_node *node)
{
    fr_kalman_sample now = *sample;
    int ready = engine->pushed >= (int64_t)engine->delay;
    keep_count(engine, room, count);
    if (engine->delay > 0u) {
        fr_kalman_sample *slot =
            samples_of(engine, room) + engine->pushed % (int64_t)engine->delay;
        now = *slot;
        *slot = *sample;
    }
    engine->pushed++;
    if (ready != 0)
        filter_sample(engine, room, &now, step, node);
    return ready;
}

int fr_kalman_engine_drain(fr_kalman_engine *engine, void *room, fr_kalman_step *step,
                           fr_kalman_node *node)
{
    int64_t next = engine->state.latest + 1;
    if (next >= engine->pushed)
        return 0;
    filter_sample(engine, room, samples_of(engine, room) + next % (int64_t)engine->delay, step,
                  node);
    return 1;
}

size_t fr_kalman_engine_waiting(const fr_kalman_engine *engine)
{
    return (size_t)(engine->pushed - engine->state.latest - 1);
}

size_t fr_kalman_engine_ready(const fr_kalman_engine *engine, size_t count)
{
    size_t waiting = fr_kalman_engine_waiting(engine) + count;
    return waiting > engine->delay ? waiting - engine->delay : 0u;
}
