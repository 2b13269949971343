/* SPDX-License-Identifier: Apache-2.0
 *
 * The International Roughness Index, steps 1 to 4 of 2.1.1, as the points come.
 *
 * Slopes are differences of elevation over the moving average, fewer points at the end, less the
 * mean slope of the start length: at that slope the car is at rest, so it starts with zero states.
 */
#include <math.h>

#include "quarter_car.h"

#define IRI_MAGIC FR_MAGIC(11)
#define LONGEST_INTERVAL_M 2.0
#define MOST_KEPT 16777216.0

struct fr_iri {
    fr_head head;
    uint32_t window, start, room; /* intervals of the moving average and of the start; points kept */
    uint32_t newest, oldest;       /* places in the ring of the next point and of the next output */
    uint64_t points, outputs;
    double total;
    fr_real per_window, per_step, per_start, start_slope;
    fr_mode modes[2];
};

fr_iri_config fr_iri_defaults(void)
{
    fr_iri_config config = {0.0, 0.25, 11.0, 80.0};
    return config;
}

/* The whole intervals next to a length, ties to even, at least 1; 0 if they are too many. */
static uint32_t intervals_in(double length_m, double interval_m)
{
    double count = rint(length_m / interval_m);
    if (!(count < MOST_KEPT))
        return 0u;
    return count < 1.0 ? 1u : (uint32_t)count;
}

static uint32_t points_kept(const fr_iri_config *config)
{
    uint32_t window = intervals_in(config->moving_average_m, config->interval_m);
    uint32_t start = intervals_in(config->start_length_m, config->interval_m);
    if (window == 0u || start == 0u)
        return 0u;
    return (window > start ? window : start) + 1u;
}

size_t fr_iri_size(const fr_iri_config *config)
{
    int possible = config != NULL && fr_above_zero(config->interval_m) &&
                   fr_above_zero(1.0 / config->interval_m) &&
                   config->interval_m <= LONGEST_INTERVAL_M && config->moving_average_m >= 0.0 &&
                   fr_finite(config->moving_average_m) && fr_above_zero(config->start_length_m) &&
                   fr_above_zero(config->speed_kmh) &&
                   fr_above_zero(config->interval_m / config->speed_kmh);
    uint32_t kept = possible ? points_kept(config) : 0u;
    return kept == 0u ? 0u : fr_sized(FR_PADDED(fr_iri), kept, sizeof(fr_real));
}

fr_status fr_iri_init(void *memory, size_t size, const fr_iri_config *config, fr_iri **out)
{
    fr_iri *iri = (fr_iri *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_iri_size(config),
                                IRI_MAGIC);
    if (status != FR_OK)
        return status;
    iri->window = intervals_in(config->moving_average_m, config->interval_m);
    iri->start = intervals_in(config->start_length_m, config->interval_m);
    iri->room = points_kept(config);
    iri->per_step = FR_R(1.0 / config->interval_m);
    iri->per_window = FR_R(1.0 / config->interval_m / iri->window);
    iri->per_start = FR_R(iri->start * config->interval_m);
    fr_golden_car(iri->modes, config->interval_m / (config->speed_kmh * (1000.0 / 3600.0)));
    *out = iri;
    return FR_OK;
}

/* Intervals whose output is known once `points` are: 0 before the slope of the start is. */
static uint64_t ready_at(const fr_iri *iri, uint64_t points)
{
    return points > iri->start && points > iri->window ? points - iri->window : 0u;
}

static fr_real *ring_of(fr_iri *iri)
{
    return (fr_real *)FR_BEHIND(iri, fr_iri);
}

/* The place that lies `ahead` of another one, which is at most the room. */
static uint32_t place_at(const fr_iri *iri, uint32_t place, uint32_t ahead)
{
    uint32_t next = place + ahead;
    return next >= iri->room ? next - iri->room : next;
}

/* What advances from point to point, in registers while a push lasts. */
typedef struct car {
    fr_mode body, axle;
    double total;
} car;

static car car_of(const fr_iri *iri)
{
    car moving = {iri->modes[0], iri->modes[1], iri->total};
    return moving;
}

static void keep_car(fr_iri *iri, const car *moving)
{
    iri->modes[0] = moving->body;
    iri->modes[1] = moving->axle;
    iri->total = moving->total;
}

/* Output of the next interval, at a slope that is reduced by that of the start. */
static inline fr_real drive(car *moving, fr_real slope)
{
    fr_real z = fr_mode_step(&moving->body, slope);
    z += fr_mode_step(&moving->axle, slope);
    moving->total += fabs((double)z);
    return z;
}

/* Keep a point in the ring. Nothing has been written over the first one when the start ends. */
static void keep_point(fr_iri *iri, fr_real z)
{
    fr_real *ring = ring_of(iri);
    ring[iri->newest] = z;
    iri->newest = place_at(iri, iri->newest, 1u);
    if (iri->points == iri->start)
        iri->start_slope = (z - ring[0]) / iri->per_start;
    iri->points++;
}

/* Write all outputs that are ready; return how many. */
static size_t drive_on(fr_iri *iri, car *moving, fr_real *trace)
{
    const fr_real *ring = ring_of(iri);
    uint64_t ready = ready_at(iri, iri->points);
    size_t made = 0;
    while (iri->outputs < ready) {
        fr_real rise = ring[place_at(iri, iri->oldest, iri->window)] - ring[iri->oldest];
        iri->oldest = place_at(iri, iri->oldest, 1u);
        trace[made] = drive(moving, rise * iri->per_window - iri->start_slope);
        iri->outputs++;
        made++;
    }
    return made;
}

/* Behind the start every point brings one output, whose other end is the oldest one. As many as
 * neither place comes to the end of the ring for. */
static size_t drive_run(fr_iri *iri, car *moving, const fr_real *elevation, size_t count,
                        fr_real *trace)
{
    fr_real *newest = ring_of(iri) + iri->newest, *oldest = ring_of(iri) + iri->oldest;
    uint32_t furthest = iri->newest > iri->oldest ? iri->newest : iri->oldest;
    size_t left = iri->room - furthest, size = count < left ? count : left;
    fr_real per_window = iri->per_window, start_slope = iri->start_slope;
    car m = *moving;
    for (size_t i = 0; i < size; i++) {
        fr_real z = elevation[i], rise = z - oldest[i];
        newest[i] = z;
        trace[i] = drive(&m, rise * per_window - start_slope);
    }
    *moving = m;
    iri->newest = place_at(iri, iri->newest, (uint32_t)size);
    iri->oldest = place_at(iri, iri->oldest, (uint32_t)size);
    iri->points += size;
    iri->outputs += size;
    return size;
}

static size_t drive_all(fr_iri *iri, car *moving, const fr_real *elevation, size_t count,
                        fr_real *trace)
{
    size_t made = 0, done = 0;
    fr_real nowhere = 0; /* NULL where no sample comes out */
    fr_real *out = trace != NULL ? trace : &nowhere;
    while (done < count && ready_at(iri, iri->points) == 0u) {
        keep_point(iri, elevation[done]);
        made += drive_on(iri, moving, out + made);
        done++;
    }
    while (done < count) {
        size_t size = drive_run(iri, moving, elevation + done, count - done, out + made);
        done += size;
        made += size;
    }
    return made;
}

fr_status fr_iri_push(fr_iri *iri, const fr_real *elevation, size_t count, fr_real *trace,
                      size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(iri, IRI_MAGIC);
    if (status == FR_OK)
        status = fr_room(0u, trace, capacity, written);
    if (status == FR_OK)
        status = fr_check_samples(elevation, count, FR_MISSING_REFUSED);
    if (status == FR_OK)
        status = fr_room((size_t)(ready_at(iri, iri->points + count) - iri->outputs), trace,
                         capacity, written);
    if (status != FR_OK)
        return status;
    car moving = car_of(iri);
    *written = drive_all(iri, &moving, elevation, count, trace);
    keep_car(iri, &moving);
    return FR_OK;
}

fr_status fr_iri_finish(fr_iri *iri, fr_real *trace, size_t capacity, size_t *written)
{
    fr_nothing(written);
    size_t made = 0;
    fr_status status = fr_ready(iri, IRI_MAGIC);
    if (status == FR_OK && iri->points <= iri->start)
        status = FR_WRONG_ORDER;
    if (status == FR_OK)
        status = fr_room((size_t)(iri->points - 1u - iri->outputs), trace, capacity, written);
    if (status != FR_OK)
        return status;
    car moving = car_of(iri);
    fr_real last = ring_of(iri)[place_at(iri, iri->newest, iri->room - 1u)];
    while (iri->outputs + 1u < iri->points) {
        fr_real rise = last - ring_of(iri)[iri->oldest];
        uint64_t left = iri->points - 1u - iri->outputs;
        iri->oldest = place_at(iri, iri->oldest, 1u);
        trace[made] = drive(&moving, rise * iri->per_step / FR_R(left) - iri->start_slope);
        iri->outputs++;
        made++;
    }
    keep_car(iri, &moving);
    iri->head.state = FR_STATE_ENDED;
    *written = made;
    return FR_OK;
}

fr_status fr_iri_value(const fr_iri *iri, fr_real *m_per_km)
{
    fr_status status = fr_readable(iri, IRI_MAGIC);
    if (status != FR_OK)
        return status;
    if (m_per_km == NULL)
        return FR_NULL_POINTER;
    if (iri->outputs == 0u)
        return FR_WRONG_ORDER;
    *m_per_km = FR_R(iri->total / (double)iri->outputs);
    return FR_OK;
}
