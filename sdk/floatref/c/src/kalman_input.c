/* SPDX-License-Identifier: Apache-2.0
 *
 * What comes into the Kalman filter: samples of the inertial unit, and GNSS readings in any order.
 */
#include <math.h>
#include <string.h>

#include "kalman_engine.h"

/* FR_OK if `x` is finite; missing samples are counted with the others where they are bridged. */
static fr_status check_doubles(const double *x, size_t count, int32_t missing)
{
    fr_status status = FR_OK;
    if (count > 0u && x == NULL)
        return FR_NULL_POINTER;
    for (size_t i = 0; i < count; i++) {
        int gone = x[i] != x[i];
        if (gone ? missing != FR_MISSING_BRIDGED : !(fabs(x[i]) <= FR_K_LARGEST))
            status = FR_BAD_SAMPLE;
    }
    return status;
}

static fr_status check_imu(const fr_imu *imu, size_t count, int32_t missing)
{
    const double *const all[] = {imu->longitudinal, imu->lateral, imu->vertical, imu->roll_rate,
                                 imu->pitch_rate, imu->yaw_rate};
    fr_status status = FR_OK;
    for (size_t i = 0; status == FR_OK && i < sizeof all / sizeof *all; i++)
        status = check_doubles(all[i], count, missing);
    return status;
}

fr_status fr_kalman_engine_check(const fr_kalman_engine *engine, const fr_imu *imu,
                                 const double *height, const int64_t *counts, size_t count)
{
    fr_status status = FR_OK;
    if (imu == NULL)
        return FR_NULL_POINTER;
    if (count > FR_MOST_SAMPLES)
        return FR_TOO_MANY;
    status = check_imu(imu, count, engine->missing);
    if (status == FR_OK)
        status = check_doubles(height, count, engine->missing);
    if (status == FR_OK)
        status = fr_check_counts(counts, count, engine->back, engine->furthest);
    return status;
}

fr_kalman_sample fr_kalman_sample_of(const fr_kalman_engine *engine, const fr_imu *imu,
                                     const double *height, size_t i)
{
    fr_kalman_sample sample = {{imu->longitudinal[i], imu->lateral[i],
                                imu->vertical[i] - engine->model.gravity, imu->roll_rate[i],
                                imu->pitch_rate[i], imu->yaw_rate[i]},
                               height[i]};
    return sample;
}

static fr_status check_reading(const fr_kalman_engine *engine, int64_t sample,
                               const double *values, const double *variances)
{
    if (values == NULL)
        return FR_NULL_POINTER;
    if (engine->references.gnss == 0)
        return FR_WRONG_ORDER;
    if (sample < 0 || sample > FR_MOST_COUNTS || values[FR_K_HEIGHT] != values[FR_K_HEIGHT] ||
        check_doubles(values, FR_K_KINDS, FR_MISSING_BRIDGED) != FR_OK)
        return FR_BAD_SAMPLE;
    for (int i = 0; variances != NULL && i < FR_K_KINDS; i++)
        if (variances[i] == variances[i] &&
            !(variances[i] >= FR_K_SMALLEST * FR_K_SMALLEST && variances[i] <= FR_K_LARGEST))
            return FR_BAD_SAMPLE;
    return sample <= engine->state.latest ? FR_TOO_LATE : FR_OK;
}

/* Readings that wait are in the order of their samples; return the place of a new one. */
static uint32_t place_of(const fr_kalman_reading *readings, uint32_t held, int64_t sample)
{
    uint32_t place = held;
    while (place > 0u && readings[place - 1u].at >= sample)
        place--;
    return place;
}

fr_status fr_kalman_engine_read(fr_kalman_engine *engine, void *room, int64_t sample,
                                const double *values, const double *variances)
{
    fr_kalman_reading *readings = fr_kalman_readings(engine, room);
    fr_status status = check_reading(engine, sample, values, variances);
    uint32_t place = place_of(readings, engine->held, sample);
    if (status == FR_OK && place < engine->held && readings[place].at == sample)
        status = FR_TOO_LATE;
    if (status == FR_OK && engine->held == engine->room)
        status = FR_QUEUE_FULL;
    if (status != FR_OK)
        return status;
    (void)memmove(readings + place + 1, readings + place,
                  (engine->held - place) * sizeof *readings);
    readings[place].at = sample;
    for (int i = 0; i < FR_K_KINDS; i++) {
        readings[place].y[i] = values[i];
        readings[place].variance[i] = variances == NULL ? (double)NAN : variances[i];
    }
    engine->held++;
    return FR_OK;
}

fr_status fr_kalman_engine_left_out(const fr_kalman_engine *engine, int64_t *count)
{
    if (count == NULL)
        return FR_NULL_POINTER;
    (void)memcpy(count, engine->state.left_out, sizeof engine->state.left_out);
    return FR_OK;
}
