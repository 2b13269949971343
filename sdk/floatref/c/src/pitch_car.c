/* SPDX-License-Identifier: Apache-2.0
 *
 * The half car that pitches over the road under its wheels. Only the places of its axles are known;
 * all else is usual, as in docs/decisions/0033-laser-place.md.
 */
#include <string.h>

#include "pitch.h"

/* The golden car of the IRI (2.1.1), over the mass that an axle carries. */
#define SPRING 63.3
#define DAMPER 6.0
#define TYRE 653.0
#define WHEEL 0.15
#define DYNAMIC_INDEX 0.8
#define BRAKE_ARM_M 0.6
#define DISTURBED_RADPS (2.0 * FR_PI) /* 1 Hz, that of an axle's bounce */

/* The force of an axle on the body over the mass that it carries: `x` m ahead of the centre. */
static void set_axle(double *force, int32_t axle, double x)
{
    (void)memset(force, 0, PT_STATES * sizeof *force);
    force[0] = -SPRING;
    force[1] = -SPRING * x;
    force[2 + axle] = SPRING;
    force[PT_BODY] = -DAMPER;
    force[PT_BODY + 1] = -DAMPER * x;
    force[PT_BODY + 2 + axle] = DAMPER;
    force[2 * PT_BODY + axle] = 1.0;
}

/* What an axle does to body and wheel. */
static void add_axle(pt_car *car, int32_t axle, double x, double inertia)
{
    double force[PT_STATES], *a = car->dynamics;
    int32_t wheel = PT_BODY + 2 + axle, disturbance = 2 * PT_BODY + axle;
    set_axle(force, axle, x);
    for (int32_t j = 0; j < PT_STATES; j++) {
        a[PT_BODY * PT_STATES + j] += 0.5 * force[j];
        a[(PT_BODY + 1) * PT_STATES + j] += 0.5 * x / inertia * force[j];
        if (j != disturbance)
            a[wheel * PT_STATES + j] -= force[j] / WHEEL;
    }
    a[wheel * PT_STATES + 2 + axle] -= TYRE / WHEEL;
    a[disturbance * PT_STATES + disturbance] = -DISTURBED_RADPS;
    car->inputs[wheel * PT_INPUTS + axle] = TYRE / WHEEL;
}

/* The accelerometer is on the rigid body, `ahead` of its centre. */
static void set_reading(pt_car *car, double ahead)
{
    int32_t heave = PT_BODY, nod = PT_BODY + 1;
    for (int32_t j = 0; j < PT_STATES; j++)
        car->reading[j] = car->dynamics[heave * PT_STATES + j] +
                          ahead * car->dynamics[nod * PT_STATES + j];
    for (int32_t j = 0; j < PT_INPUTS; j++)
        car->direct[j] =
            car->inputs[heave * PT_INPUTS + j] + ahead * car->inputs[nod * PT_INPUTS + j];
}

void fr_pt_set_car(pt_car *car, const fr_pitch_config *config)
{
    double half = 0.5 * (config->front_m - config->rear_m);
    double inertia = DYNAMIC_INDEX * half * half;
    (void)memset(car, 0, sizeof *car);
    for (int32_t i = 0; i < PT_BODY; i++)
        car->dynamics[i * PT_STATES + PT_BODY + i] = 1.0;
    add_axle(car, 0, half, inertia);
    add_axle(car, 1, -half, inertia);
    car->inputs[(PT_BODY + 1) * PT_INPUTS + 2] = BRAKE_ARM_M / inertia;
    set_reading(car, half - config->front_m - config->lever_m);
}
