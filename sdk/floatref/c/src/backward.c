/* SPDX-License-Identifier: Apache-2.0
 *
 * The backward pass over a finished array, fig. 5.12.
 */
#include "backward.h"
#include "section.h"

#include <string.h>

void fr_pass_backward(const fr_schedule *schedule, const fr_tangent *tangent, fr_real largest,
                      const fr_real *elevation, const fr_real *speed, size_t count,
                      fr_real *profile)
{
    fr_section first, second;
    (void)memset(&first, 0, sizeof first);
    (void)memset(&second, 0, sizeof second);
    size_t behind = count;
    while (behind > 0u) {
        size_t size = behind < FR_BLOCK ? behind : FR_BLOCK, low = behind - size;
        fr_real cutoff[FR_BLOCK], c[FR_BLOCK];
        fr_frequencies(schedule, speed + low, size, cutoff);
        if (largest > 0)
            fr_wave_numbers(speed + low, largest, size, cutoff);
        fr_tangents(tangent, cutoff, size, c);
        for (size_t k = size; k > 0u; k--)
            profile[low + k - 1u] =
                fr_section_21_any(&second, &first, elevation[low + k - 1u], c[k - 1u]);
        behind = low;
    }
}
