/* SPDX-License-Identifier: Apache-2.0
 *
 * What the fit of a stop takes sensors, vehicle and road for, by the names of
 * docs/road-prior-slope.md; what a caller may set is in fr_level_fit_config.
 */
#ifndef FR_LEVEL_MODEL_H
#define FR_LEVEL_MODEL_H

#define LV_INTERVAL_S 0.06
#define LV_READING_M 1e-4
#define LV_SWAY_M 0.5
#define LV_BEND_WEIGHT 1.0
#define LV_MOST_BEND 4000.0
#define LV_FIRST_BEND 30.0
#define LV_SEGMENT 40 /* points of the 10 m that have one intensity of bends */
#define LV_SLOPE 0.06
#define LV_SLOPE_REACH_M 60.0
#define LV_START_M 1.0
#define LV_FORCE_SHARE 0.003
#define LV_OFFSET_M 1.0
#define LV_OFFSET_WALK 2e-4
#define LV_REST_S 1.0
#define LV_FIRST_SAG_M 1e-3
#define LV_MOMENT_SIGMA 0.1
#define LV_MOMENT_WALK 0.02
#define LV_MOMENT_SHARE 0.3
#define LV_BOUNCE 1e-3
#define LV_BOUNCE_SPEED 4e-4
#define LV_SWING 1e-3
#define LV_SWING_SPEED 4e-4
#define LV_HEAVE_M 5e-6
#define LV_HEAVE_SPEED 1.3e-5
#define LV_NOD_RAD 5e-6
#define LV_NOD_SPEED 7e-6
#define LV_JOLT_BOUNCE 0.003
#define LV_JOLT_PITCH 0.015
#define LV_CENTRE 0.5
#define LV_CENTRE_SIGMA 0.2
#define LV_STIFFNESS_SIGMA 0.6
#define LV_DAMPING_SIGMA 0.8
#define LV_GYRATION 0.9
#define LV_GYRATION_SIGMA 0.15

/* Outside of these ranges there is no vehicle. */
#define LV_LEAST_GAIN 0.0005
#define LV_MOST_GAIN 0.02

#define LV_STANDING_MPS 0.02
#define LV_MOVING_MPS 0.5
#define LV_BRAKING_MPS2 0.5
#define LV_SHORTEST_S 2.0
#define LV_SHORTEST_PIECE_S 0.5
#define LV_UNKNOWN_M 0.05

/* Distance between places at which the 1-sigma is found. */
#define LV_MARKS_M 8.0

/* Cut-off wavelengths to either side beyond which the low-pass is nothing. */
#define LV_REACH 1.5

#endif
