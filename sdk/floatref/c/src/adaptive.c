/* SPDX-License-Identifier: Apache-2.0
 *
 * The recommended temporal algorithm whole, 5.7: from force, height and counts to the profile.
 */
#include "backward.h"
#include "datum.h"
#include "integral.h"
#include "points.h"
#include "section.h"

#define ADAPTIVE_MAGIC FR_MAGIC(8)
#define RAREST 65536

/* All that the forward filters remember. */
typedef struct motion {
    fr_section acceleration, velocity, height_1, height_2;
    fr_trapezoid first, second;
    fr_datum datum;
    fr_real elevation, speed; /* of the last sample */
} motion;

struct fr_adaptive {
    fr_head head;
    int32_t missing, tangent_form;
    int32_t every, until; /* samples between updates of the cut-off, and until the next one */
    fr_real gravity, c;
    fr_schedule schedule;
    fr_tangent tangent;
    fr_travel travel;
    fr_points points;
    motion motion;
};

fr_adaptive_config fr_adaptive_defaults(void)
{
    fr_adaptive_config config = {{0.0, 0.0, 0.0, FR_BACK_REFUSED},
                                 {0.0, 0.0, 0.0, 0.0},
                                 0.0, 0.0, FR_MISSING_REFUSED, FR_TANGENT_EXACT, 1};
    config.travel = fr_travel_speed_defaults();
    config.cut_off = fr_cut_off_defaults();
    return config;
}

static int adaptive_is_possible(const fr_adaptive_config *config)
{
    return fr_travel_window(&config->travel) > 0u && fr_cut_off_is_possible(&config->cut_off) &&
           fr_points_are_possible(config->interval_m, config->travel.metres_per_count) &&
           fr_finite(config->gravity_mps2) &&
           fr_one_of(config->missing, FR_MISSING_REFUSED, FR_MISSING_BRIDGED) &&
           fr_one_of(config->tangent, FR_TANGENT_EXACT, FR_TANGENT_SHORT) &&
           fr_one_of(config->cut_off_every, 1, RAREST);
}

size_t fr_adaptive_size(const fr_adaptive_config *config)
{
    if (config == NULL || !adaptive_is_possible(config))
        return 0u;
    return fr_sized(FR_PADDED(fr_adaptive), fr_travel_window(&config->travel), sizeof(int64_t));
}

fr_status fr_adaptive_init(void *memory, size_t size, const fr_adaptive_config *config,
                           fr_adaptive **out)
{
    fr_adaptive *adaptive = (fr_adaptive *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_adaptive_size(config),
                                ADAPTIVE_MAGIC);
    if (status != FR_OK)
        return status;
    adaptive->missing = config->missing;
    adaptive->tangent_form = config->tangent;
    adaptive->every = config->cut_off_every;
    adaptive->gravity = FR_R(config->gravity_mps2);
    adaptive->schedule = fr_schedule_of(&config->cut_off);
    adaptive->tangent = fr_tangent_of(1.0 / config->travel.rate_hz, config->tangent);
    fr_travel_set(&adaptive->travel, &config->travel);
    adaptive->travel.missing = config->missing;
    fr_points_set(&adaptive->points, config->interval_m, config->travel.metres_per_count);
    *out = adaptive;
    return FR_OK;
}

/* c of a block of samples: of each, or of every N-th from the first one of the run. */
static void cut_offs(fr_adaptive *adaptive, const fr_real *speed, size_t size, fr_real *c)
{
    fr_real cutoff[FR_BLOCK];
    if (adaptive->every == 1) {
        fr_frequencies(&adaptive->schedule, speed, size, cutoff);
        fr_tangents(&adaptive->tangent, cutoff, size, c);
        return;
    }
    for (size_t i = 0; i < size; i++) {
        if (adaptive->until == 0) {
            fr_frequencies(&adaptive->schedule, speed + i, 1u, cutoff);
            fr_tangents(&adaptive->tangent, cutoff, 1u, &adaptive->c);
            adaptive->until = adaptive->every;
        }
        adaptive->until--;
        c[i] = adaptive->c;
    }
}

/* Elevations of samples that may be the first ones, or missing. */
static void move_carefully(motion *m, fr_real half_step, fr_real gravity, const fr_real *a,
                           const fr_real *h, const fr_real *c, size_t size, fr_real *elevation)
{
    for (size_t i = 0; i < size; i++) {
        fr_real force = fr_section_1_any(&m->acceleration, a[i] - gravity, c[i]);
        fr_real speed = fr_trapezoid_step(&m->first, force, half_step);
        fr_real slow = fr_section_2_any(&m->velocity, speed, c[i]);
        fr_real reference = fr_trapezoid_step(&m->second, slow, half_step);
        fr_real height = fr_from_datum(&m->datum, h[i]);
        elevation[i] = reference - fr_section_12_any(&m->height_1, &m->height_2, height, c[i]);
    }
}

/* The same of samples that are all there, behind the first one: a copy of the states stays in
 * registers, and the four recursions overlap. */
static void move_quickly(motion *m, fr_real half_step, fr_real gravity, const fr_real *a,
                         const fr_real *h, const fr_real *c, size_t size, fr_real *elevation)
{
    fr_section s_1 = m->acceleration, s_2 = m->velocity, h_1 = m->height_1, h_2 = m->height_2;
    fr_trapezoid first = m->first, second = m->second;
    fr_real datum = m->datum.height;
    for (size_t i = 0; i < size; i++) {
        fr_real force = fr_section_1_step(&s_1, a[i] - gravity, c[i]);
        fr_real speed = fr_trapezoid_step(&first, force, half_step);
        fr_real slow = fr_section_2_step(&s_2, speed, c[i]);
        fr_real reference = fr_trapezoid_step(&second, slow, half_step);
        elevation[i] = reference - fr_section_12_step(&h_1, &h_2, h[i] - datum, c[i]);
    }
    m->acceleration = s_1;
    m->velocity = s_2;
    m->height_1 = h_1;
    m->height_2 = h_2;
    m->first = first;
    m->second = second;
}

/* Take the points that a block of samples reaches; return how many. */
static size_t take_points(fr_adaptive *adaptive, const int64_t *counts, const fr_real *z,
                          const fr_real *v, size_t size, fr_real *elevation, fr_real *speed)
{
    fr_place_of_point place;
    motion *m = &adaptive->motion;
    size_t made = 0;
    fr_points_begin(&adaptive->points, counts[0]);
    for (size_t i = 0; i < size; i++) {
        while (fr_points_reached(&adaptive->points, counts[i]) != 0) {
            fr_points_next(&adaptive->points, counts[i], &place);
            elevation[made] = fr_points_read(&place, i > 0u ? z[i - 1u] : m->elevation, z[i]);
            speed[made] = fr_points_read(&place, i > 0u ? v[i - 1u] : m->speed, v[i]);
            made++;
        }
        fr_points_pass(&adaptive->points, counts[i]);
    }
    m->elevation = z[size - 1u];
    m->speed = v[size - 1u];
    return made;
}

static void run_adaptive(fr_adaptive *adaptive, const fr_real *a, const fr_real *h,
                         const int64_t *counts, size_t count, fr_real *elevation, fr_real *speed)
{
    int64_t *ring = (int64_t *)FR_BEHIND(adaptive, fr_adaptive);
    fr_real half = FR_R((double)adaptive->tangent.step / 2.0), g = adaptive->gravity;
    fr_real v[FR_BLOCK], c[FR_BLOCK], z[FR_BLOCK];
    motion *m = &adaptive->motion;
    size_t done = 0, made = 0;
    fr_real nowhere = 0; /* NULL where no point is reached */
    fr_real *z_out = elevation != NULL ? elevation : &nowhere;
    fr_real *v_out = speed != NULL ? speed : &nowhere;
    while (done < count) {
        int careful = adaptive->missing == FR_MISSING_BRIDGED || !fr_section_started(&m->height_2);
        size_t most = careful && adaptive->missing == FR_MISSING_REFUSED ? 1u : FR_BLOCK;
        size_t size = count - done < most ? count - done : most;
        fr_travel_speeds(&adaptive->travel, ring, counts, done, size, v);
        cut_offs(adaptive, v, size, c);
        if (careful)
            move_carefully(m, half, g, a + done, h + done, c, size, z);
        else
            move_quickly(m, half, g, a + done, h + done, c, size, z);
        made += take_points(adaptive, counts + done, z, v, size, z_out + made, v_out + made);
        done += size;
    }
    fr_travel_keep(&adaptive->travel, ring, counts, count);
}

/* Whether the cut-off of every speed of a push is possible. */
static fr_status check_cut_offs(fr_adaptive *adaptive, const int64_t *counts, size_t count)
{
    const int64_t *ring = (const int64_t *)FR_BEHIND(adaptive, fr_adaptive);
    fr_travel ahead = adaptive->travel;
    fr_status status = FR_OK;
    fr_real speed[FR_BLOCK];
    for (size_t done = 0; status == FR_OK && done < count; done += FR_BLOCK) {
        size_t size = count - done < FR_BLOCK ? count - done : FR_BLOCK;
        fr_travel_speeds(&ahead, ring, counts, done, size, speed);
        status = fr_check_speeds(&adaptive->schedule, &adaptive->tangent, speed, size,
                                 FR_MISSING_REFUSED);
    }
    return status;
}

static fr_status check_adaptive(fr_adaptive *adaptive, const fr_real *acceleration,
                                const fr_real *height, const int64_t *counts, size_t count,
                                size_t *needed)
{
    fr_status status = fr_check_samples(acceleration, count, adaptive->missing);
    if (status == FR_OK)
        status = fr_check_samples(height, count, adaptive->missing);
    if (status == FR_OK)
        status = fr_travel_check(&adaptive->travel, counts, count);
    if (status == FR_OK)
        status = check_cut_offs(adaptive, counts, count);
    return status == FR_OK ? fr_points_needed(&adaptive->points, counts, count, needed) : status;
}

fr_status fr_adaptive_push(fr_adaptive *adaptive, const fr_real *acceleration,
                           const fr_real *height, const int64_t *counts, size_t count,
                           fr_real *elevation, fr_real *speed, size_t capacity, size_t *written)
{
    fr_nothing(written);
    size_t needed = 0;
    fr_status status = fr_ready(adaptive, ADAPTIVE_MAGIC);
    if (status == FR_OK)
        status = fr_room(0u, elevation, capacity, written);
    if (status == FR_OK)
        status = check_adaptive(adaptive, acceleration, height, counts, count, &needed);
    if (status == FR_OK)
        status = fr_room(needed, elevation, capacity, written);
    if (status == FR_OK && needed > 0u && speed == NULL)
        status = FR_NULL_POINTER;
    if (status != FR_OK)
        return status;
    run_adaptive(adaptive, acceleration, height, counts, count, elevation, speed);
    *written = needed;
    return FR_OK;
}

fr_status fr_adaptive_finish(fr_adaptive *adaptive, const fr_real *elevation, const fr_real *speed,
                             size_t count, fr_real *profile, size_t capacity, size_t *written)
{
    fr_nothing(written);
    fr_status status = fr_ready(adaptive, ADAPTIVE_MAGIC);
    if (status == FR_OK)
        status = fr_room(count, profile, capacity, written);
    if (status == FR_OK)
        status = fr_check_samples(elevation, count, FR_MISSING_REFUSED);
    if (status == FR_OK)
        status = fr_check_samples(speed, count, FR_MISSING_REFUSED);
    if (status == FR_OK && (count == 0u || (uint64_t)adaptive->points.next != count))
        status = FR_INCOMPLETE_SET;
    if (status != FR_OK)
        return status;
    double interval_m = adaptive->points.interval_m;
    fr_tangent tangent = fr_tangent_of(interval_m, adaptive->tangent_form);
    fr_pass_backward(&adaptive->schedule, &tangent, fr_largest_wave_number(interval_m), elevation,
                     speed, count, profile);
    adaptive->head.state = FR_STATE_ENDED;
    *written = count;
    return FR_OK;
}
