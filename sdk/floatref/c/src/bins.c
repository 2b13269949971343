/* SPDX-License-Identifier: Apache-2.0
 *
 * Whether the samples of several wheel paths can go into bins.
 */
#include "bins.h"

fr_status fr_check_paths(const fr_real *x, size_t count, int32_t paths, int32_t missing)
{
    size_t values = count * (size_t)paths;
    fr_status status = count > FR_MOST_SAMPLES / (size_t)paths
                           ? FR_TOO_MANY
                           : fr_check_samples(x, values, missing);
    for (size_t i = 0; i < values && status == FR_OK; i++)
        if (x[i] > FR_R(FR_LARGEST_VALUE) || x[i] < FR_R(-FR_LARGEST_VALUE))
            status = FR_BAD_SAMPLE;
    return status;
}
