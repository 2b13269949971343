/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks of whole arrays, before the first sample changes a state.
 */
#include <string.h>

#include "samples.h"

/* The bits of a sample, of its sign, of its exponent, and the lowest of these. Arrays are checked as
 * integers, since they are compared faster than samples everywhere, and on a small core much
 * faster. */
#ifdef FR_FLOAT
typedef uint32_t bits;
#define SIGN UINT32_C(0x80000000)
#define EXPONENT UINT32_C(0x7f800000)
#define LOWEST UINT32_C(0x00800000)
#else
typedef uint64_t bits;
#define SIGN UINT64_C(0x8000000000000000)
#define EXPONENT UINT64_C(0x7ff0000000000000)
#define LOWEST UINT64_C(0x0010000000000000)
#endif

static inline bits bits_of(fr_real x)
{
    bits same;
    (void)memcpy(&same, &x, sizeof same);
    return same;
}

/* Whether all samples are finite: of a number that is not, the exponent is all ones, and one more
 * carries into the sign. */
static int all_finite(const fr_real *x, size_t count)
{
    bits carried = 0;
    for (size_t i = 0; i < count; i++)
        carried |= (bits_of(x[i]) & EXPONENT) + LOWEST;
    return (carried & SIGN) == 0u;
}

/* Numbers of one sign are in the order of their bits, and infinity and NaN lie behind them. */
int fr_all_within(const fr_real *x, size_t count, fr_real most)
{
    bits limit = bits_of(most), outside = 0;
    for (size_t i = 0; i < count; i++)
        outside |= (limit - bits_of(x[i])) | bits_of(x[i]);
    return most > 0 && fr_finite((double)most) && (outside & SIGN) == 0u;
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
