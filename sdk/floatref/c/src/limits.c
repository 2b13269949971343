/* SPDX-License-Identifier: Apache-2.0
 *
 * Limits of the screening from what is usual of a sensor: those of the SDK (decision 0012).
 */
#include <math.h>

#include "samples.h"

#define GRAVITY 9.80665
/* Smallest spike of a height, deeper than a crack, and of an accelerometer on the body. */
#define SPIKE_M 0.05
#define SPIKE_MPS2 (0.5 * GRAVITY)
/* White noise of a million samples reaches 8 usual distances from the neighbours. */
#define UNUSUAL 15.0
#define SPIKES_FROM_HZ 1000.0
#define STUCK_FORCE_S 0.02
/* Holds of more samples are counted together, so they are not known. */
#define LONGEST_HOLD 4096.0

static fr_screening_config screening_of(double rate_hz, double metres_per_count,
                                        const fr_usual_values *usual, double spike)
{
    fr_screening_config config = fr_screening_defaults();
    if (usual == NULL)
        return config;
    config.rate_hz = rate_hz;
    config.metres_per_count = metres_per_count;
    config.hold = fmin(fmax(usual->hold_of_samples, 1.0), LONGEST_HOLD);
    if (rate_hz >= SPIKES_FROM_HZ)
        config.spike = fmax(spike, UNUSUAL * usual->off_neighbours);
    return config;
}

fr_screening_config fr_screening_of_height(double rate_hz, double metres_per_count,
                                           const fr_usual_values *usual)
{
    fr_screening_config config = screening_of(rate_hz, metres_per_count, usual, SPIKE_M);
    config.range_least = usual != NULL ? usual->least : 0.0;
    config.range_greatest = usual != NULL ? usual->greatest : 0.0;
    return config;
}

fr_screening_config fr_screening_of_force(double rate_hz, double metres_per_count,
                                          const fr_usual_values *usual)
{
    fr_screening_config config = screening_of(rate_hz, metres_per_count, usual, SPIKE_MPS2);
    config.stuck_s = STUCK_FORCE_S;
    config.spread_mps2 = 0.0;
    return config;
}

fr_saturation_config fr_saturation_of(const fr_usual_values *usual)
{
    fr_saturation_config config = fr_saturation_defaults();
    if (usual == NULL)
        return config;
    config.hold = fmin(fmax(usual->hold_of_holds, 1.0), LONGEST_HOLD);
    config.quantum = usual->quantum;
    config.range_least = usual->least;
    config.range_greatest = usual->greatest;
    return config;
}
