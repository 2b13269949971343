/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks of whole arrays, before the first sample changes a state.
 */
#include "samples.h"

/* As wide as fr_real, so that a loop over both can be vectorized. */
#ifdef FR_FLOAT
typedef int32_t mask;
#else
typedef int64_t mask;
#endif

/* Whether all samples are finite. One loop without a branch. */
static int all_finite(const fr_real *x, size_t count)
{
    mask wrong = 0;
    for (size_t i = 0; i < count; i++) {
        fr_real zero = x[i] - x[i];
        wrong |= zero != zero;
    }
    return wrong == 0;
}

fr_status fr_check_samples(const fr_real *x, size_t count, int32_t missing)
{
    if (count > 0u && x == NULL)
        return FR_NULL_POINTER;
    if (count > FR_MOST_SAMPLES)
        return FR_TOO_MANY;
    if (all_finite(x, count))
        return FR_OK;
    for (size_t i = 0; i < count; i++) {
        fr_real zero = x[i] - x[i];
        if (zero != zero && (!fr_missing(x[i]) || missing != FR_MISSING_BRIDGED))
            return FR_BAD_SAMPLE;
    }
    return FR_OK;
}

fr_status fr_check_steps(const fr_real *x, size_t count)
{
    fr_status status = fr_check_samples(x, count, FR_MISSING_REFUSED);
    int wrong = 0;
    for (size_t i = 0; status == FR_OK && i < count; i++)
        wrong |= x[i] < 0;
    return wrong != 0 ? FR_BAD_SAMPLE : status;
}
