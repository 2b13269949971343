/* SPDX-License-Identifier: Apache-2.0
 *
 * What is usual of a sensor, learned from a calibration drive: the ends of its samples, its
 * smallest step, how long it holds a reading, and its noise from sample to sample.
 */
#include <math.h>
#include <string.h>

#include "travel.h"

#define USUAL_MAGIC FR_MAGIC(27)
#define MOST_LONGEST (1 << 20)
/* Eight bins of noise for each power of two, from 2^-40 on. */
enum { BINS = 512, BINS_OF_OCTAVE = 8, LOWEST_OCTAVE = -40 };

struct fr_usual {
    fr_head head;
    int32_t longest, known; /* holds from this on are counted together; samples before, two at most */
    int64_t length;         /* of the hold that is open */
    double value, before;   /* of it, and of the one before it */
    double least, greatest, quantum;
    double in_long;         /* samples in the longest holds */
    int64_t samples, furthest; /* count of an encoder */
    uint32_t noise[BINS]; /* distances from the neighbours, or rises of an encoder */
};

fr_usual_config fr_usual_defaults(void)
{
    fr_usual_config config = {4096, 0};
    return config;
}

size_t fr_usual_size(const fr_usual_config *config)
{
    if (config == NULL || !fr_one_of(config->longest, 2, MOST_LONGEST) || config->reserved != 0)
        return 0u;
    return FR_PADDED(fr_usual) + (size_t)config->longest * sizeof(uint32_t);
}

fr_status fr_usual_init(void *memory, size_t size, const fr_usual_config *config, fr_usual **out)
{
    fr_usual *usual = (fr_usual *)memory;
    fr_status status = fr_place(memory, size, config, (const void *)out, fr_usual_size(config),
                                USUAL_MAGIC);
    if (status != FR_OK)
        return status;
    usual->longest = config->longest;
    usual->least = HUGE_VAL;
    usual->greatest = -HUGE_VAL;
    usual->quantum = HUGE_VAL;
    *out = usual;
    return FR_OK;
}

/* Count a hold that has ended, longer ones together. */
static void count_hold(fr_usual *usual)
{
    uint32_t *held = (uint32_t *)FR_BEHIND(usual, fr_usual);
    int64_t last = (int64_t)usual->longest - 1;
    held[usual->length < last ? usual->length : last]++;
    if (usual->length >= last)
        usual->in_long += (double)usual->length;
}

static void count_noise(fr_usual *usual, double off)
{
    int octave = 0;
    double part = frexp(off, &octave);
    double bin = (double)BINS_OF_OCTAVE * ((double)(octave - LOWEST_OCTAVE) + log2(part));
    if (off > 0.0 && fr_finite(off)) {
        int place = (int)floor(fmin(fmax(bin, 0.0), (double)BINS - 1.0));
        usual->noise[place]++;
    }
}

/* A new reading `x` ends the hold; repeated samples count once for the noise. */
static void end_hold(fr_usual *usual, double x)
{
    count_hold(usual);
    usual->quantum = fmin(usual->quantum, fabs(x - usual->value));
    if (usual->known == 2)
        count_noise(usual, fabs(usual->value - 0.5 * (usual->before + x)));
    usual->before = usual->value;
    usual->known = 2;
}

static void learn_sample(fr_usual *usual, double x)
{
    if (x != x) {
        if (usual->length > 0)
            count_hold(usual);
        usual->length = 0;
        usual->known = 0;
        return;
    }
    usual->samples++;
    usual->least = fmin(usual->least, x);
    usual->greatest = fmax(usual->greatest, x);
    if (usual->length > 0 && x == usual->value) {
        usual->length++;
        return;
    }
    if (usual->length > 0)
        end_hold(usual, x);
    else
        usual->known = 1;
    usual->value = x;
    usual->length = 1;
}

fr_status fr_usual_push(fr_usual *usual, const fr_real *x, size_t count)
{
    fr_status status = fr_ready(usual, USUAL_MAGIC);
    if (status == FR_OK)
        status = fr_check_samples(x, count, FR_MISSING_BRIDGED);
    for (size_t i = 0; status == FR_OK && i < count; i++)
        learn_sample(usual, (double)x[i]);
    return status;
}

fr_status fr_usual_push_counts(fr_usual *usual, const int64_t *counts, size_t count)
{
    fr_status status = fr_ready(usual, USUAL_MAGIC);
    if (status == FR_OK)
        status = fr_check_known_counts(counts, count, FR_BACK_TAKEN, 0);
    for (size_t i = 0; status == FR_OK && i < count; i++) {
        if (counts[i] == FR_NO_COUNT)
            continue;
        if (usual->samples > 0 && counts[i] > usual->furthest)
            count_noise(usual, (double)(counts[i] - usual->furthest));
        if (usual->samples == 0 || counts[i] > usual->furthest)
            usual->furthest = counts[i];
        usual->samples++;
    }
    return status;
}

/* Shortest hold within which half of the holds lie, or half of the samples; infinite if that is
 * among the longest ones. */
static double middle_hold(const fr_usual *usual, const uint32_t *held, int of_samples)
{
    double all = 0.0, sum = 0.0;
    int32_t last = usual->longest - 1, length = 0;
    for (int32_t n = 0; n < last; n++)
        all += (of_samples ? (double)n : 1.0) * (double)held[n];
    all += of_samples ? usual->in_long : (double)held[last];
    while (length < last && sum < fmax(all, 1.0) / 2.0) {
        sum += (of_samples ? (double)length : 1.0) * (double)held[length];
        length++;
    }
    return sum >= fmax(all, 1.0) / 2.0 ? (double)length - 1.0 : HUGE_VAL;
}

/* The middle of the bin in which the median lies. */
static double middle_noise(const fr_usual *usual)
{
    double all = 0.0, sum = 0.0;
    int bin = 0;
    for (int n = 0; n < BINS; n++)
        all += (double)usual->noise[n];
    if (all <= 0.0)
        return 0.0;
    while (sum < all / 2.0) {
        sum += (double)usual->noise[bin];
        bin++;
    }
    double octave = ((double)bin - 0.5) / (double)BINS_OF_OCTAVE + (double)LOWEST_OCTAVE;
    return pow(2.0, octave);
}

fr_status fr_usual_value(const fr_usual *usual, fr_usual_values *values)
{
    fr_status status = fr_ready(usual, USUAL_MAGIC);
    if (status == FR_OK && values == NULL)
        status = FR_NULL_POINTER;
    if (status == FR_OK && usual->samples == 0)
        status = FR_WRONG_ORDER;
    if (status != FR_OK)
        return status;
    const uint32_t *held = (const uint32_t *)FR_BEHIND(usual, fr_usual);
    values->least = usual->least;
    values->greatest = usual->greatest;
    values->quantum = fr_finite(usual->quantum) ? usual->quantum : 0.0;
    values->hold_of_holds = middle_hold(usual, held, 0);
    values->hold_of_samples = middle_hold(usual, held, 1);
    values->off_neighbours = middle_noise(usual);
    values->rise = values->off_neighbours;
    values->samples = usual->samples;
    return FR_OK;
}
