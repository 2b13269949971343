/* SPDX-License-Identifier: Apache-2.0
 *
 * The pitch of the body, of two wheel paths: levelling by the road, and the model.
 */
#include "driven.h"

#define FRONT_M 1.5
#define REAR_M (-1.5)

static fr_level_bin bins[POINTS];

static fr_status push_level(void *object, size_t count, size_t *written)
{
    fr_level *level = (fr_level *)object;
    size_t ready = 0;
    fr_status status = fr_level_push(level, on_road.forces, on_road.heights, on_road.counts, count,
                                     &ready);
    return status == FR_OK ? fr_level_take(level, bins, POINTS, written) : status;
}

static fr_status end_level(void *object, size_t *written)
{
    size_t ready = 0;
    fr_status status = fr_level_finish((fr_level *)object, &ready);
    *written = 0u;
    return status;
}

static void put_bins(size_t written, const fr_level_bin *of)
{
    for (size_t i = 0; i < written; i++)
        heights[i] = of[i].added + of[i].sigma_m + (double)of[i].first;
    put_doubles(written, heights);
}

static fr_level_config level_of(double longest_s, double most_travel_m, int32_t most_width)
{
    fr_level_config config = fr_level_defaults();
    config.rate_hz = RATE_HZ;
    config.metres_per_count = COUNT_M;
    config.fit.front_m = FRONT_M;
    config.fit.rear_m = REAR_M;
    config.fit.longest_s = longest_s;
    config.fit.most_travel_m = most_travel_m;
    config.fit.most_width = most_width;
    return config;
}

/* Without a brake, so without a fit. */
void stage_level(void)
{
    const length run = {3.5, 1.0};
    fr_level_config config = level_of(60.0, 600.0, 80);
    begin_drive(60000);
    DRIVE(level, config, run, put_bins, bins);
}

/* Bins of a stop, from the drive at one sample for each. */
typedef struct stop {
    int64_t number[POINTS];
    double force[POINTS], missing[POINTS], height[POINTS], travel[POINTS], speed[POINTS],
        along[POINTS], pitch[POINTS], sigma_m[POINTS];
} stop;

static stop brake;

/* A body on springs over both axles, in heave and in pitch: places, and how fast they change. */
typedef struct body {
    double heave, pitch, heave_speed, pitch_speed, front, rear, lifted;
} body;

/* One step of 2 ms with natural frequencies of 1.35 and 1.6 Hz and 0.3 of the critical damping. */
static void move_body(body *b, double travel, double along)
{
    const double step = 0.002, of_heave = 72.0, of_pitch = 101.0, wheelbase = FRONT_M - REAR_M;
    double front = drive_road(travel + FRONT_M), rear = drive_road(travel + REAR_M);
    double rises = (front - b->front) / step, falls = (rear - b->rear) / step;
    double turned = of_pitch * ((front - rear) / wheelbase + 0.005 * along - b->pitch) +
                    6.0 * ((rises - falls) / wheelbase - b->pitch_speed);
    b->lifted = of_heave * (0.5 * (front + rear) - b->heave) +
                5.1 * (0.5 * (rises + falls) - b->heave_speed);
    b->heave_speed += step * b->lifted;
    b->pitch_speed += step * turned;
    b->heave += step * b->heave_speed;
    b->pitch += step * b->pitch_speed;
    b->front = front;
    b->rear = rear;
}

/* Means of five samples. */
static void set_bin(body *b, size_t i)
{
    brake.number[i] = (int64_t)i;
    brake.force[i] = brake.height[i] = brake.travel[i] = brake.speed[i] = brake.along[i] = 0.0;
    for (size_t k = 0; k < 5u; k++) {
        double along = on_road.along[k], place = 100.0 + on_road.travel[k];
        move_body(b, place, along);
        double felt = along * b->pitch + 0.5 * GRAVITY_MPS2 * b->pitch * b->pitch;
        brake.force[i] += 0.2 * (b->lifted - felt);
        brake.height[i] += 0.2 * (0.25 + b->heave - drive_road(place));
        brake.travel[i] += 0.2 * on_road.travel[k];
        brake.speed[i] += 0.2 * on_road.speed[k];
        brake.along[i] += 0.2 * along;
    }
}

static fr_level_bins bins_of(size_t count)
{
    fr_level_bins given = {brake.number, brake.force, brake.missing, brake.height,
                           brake.travel, brake.speed, brake.along,   count};
    body moved = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    moved.front = moved.rear = moved.heave = drive_road(100.0);
    begin_drive(1500);
    on_road.rate = 500u;
    for (size_t i = 0; i < count; i++) {
        drive_next(&on_road, 5u);
        set_bin(&moved, i);
    }
    return given;
}

static void try_fit(size_t count)
{
    fr_level_fit_config config = level_of(10.0, 150.0, 96).fit;
    fr_level_bins given = bins_of(count);
    fr_level_result result;
    size_t written = 0;
    uint32_t begin = board_ticks(), ticks;
    if (fr_level_fit(&config, large, sizeof large, &given, &result, brake.pitch, brake.sigma_m,
                     POINTS, &written) != FR_OK)
        board_put("refused\n");
    ticks = since(begin);
    if (result.outcome != FR_LEVEL_FOUND)
        board_put("not found\n");
    put_costs(fr_level_fit_size(&config), written, ticks, ticks);
    put_doubles(written, brake.pitch);
}

/* Its samples are bins of 10 ms. */
void stage_level_fit_8_s(void)
{
    try_fit(800u);
}

static fr_status push_pitch(void *object, size_t count, size_t *written)
{
    fr_pitch *pitch = (fr_pitch *)object;
    size_t ready = 0;
    fr_status status = fr_pitch_push(pitch, on_road.forces, on_road.heights, on_road.counts, count,
                                     &ready);
    return status == FR_OK ? fr_pitch_take(pitch, heights, POINTS, written) : status;
}

static fr_status end_pitch(void *object, size_t *written)
{
    size_t ready = 0;
    fr_status status = fr_pitch_finish((fr_pitch *)object, &ready);
    return status == FR_OK ? fr_pitch_take((fr_pitch *)object, heights, POINTS, written) : status;
}

/* The longest windows that tests can wait for; the cost of a bin is that of 600 s. */
static void try_pitch(double window_s)
{
    const length run = {window_s + 5.0, window_s};
    fr_pitch_config config = fr_pitch_defaults();
    config.rate_hz = RATE_HZ;
    config.metres_per_count = COUNT_M;
    config.front_m = FRONT_M;
    config.rear_m = REAR_M;
    config.window_s = window_s;
    config.shared_s = 5.0;
    begin_drive(2000);
    DRIVE(pitch, config, run, put_doubles, heights);
}

void stage_pitch_window_5_s(void)
{
    try_pitch(5.0);
}

void stage_pitch_window_10_s(void)
{
    try_pitch(10.0);
}
