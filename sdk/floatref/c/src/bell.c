/* SPDX-License-Identifier: Apache-2.0
 *
 * The second derivative of a distance under a Gaussian.
 */
#include <math.h>

#include "bell.h"

#define BELL_S 0.06
#define BELL_REACH 4.0

int32_t fr_bell_reach(double step_s)
{
    int32_t reach = (int32_t)rint(BELL_REACH * BELL_S / step_s);
    return reach < 2 ? 2 : reach;
}

void fr_bell_set(double *weight, int32_t reach, double step_s)
{
    double moment = 0.0, total = 0.0, scale = 0.0;
    for (int32_t i = -reach; i <= reach; i++) {
        double place = (double)i * step_s, x = place / BELL_S;
        total += exp(-0.5 * x * x);
        moment += exp(-0.5 * x * x) * place * place;
    }
    for (int32_t i = -reach; i <= reach; i++) {
        double place = (double)i * step_s, x = place / BELL_S;
        double here = exp(-0.5 * x * x) * (place * place - moment / total);
        scale += here * place * place;
        weight[i < 0 ? -i : i] = here;
    }
    for (int32_t i = 0; i <= reach; i++)
        weight[i] *= 2.0 / scale;
}

static double at_bin(const fr_bell *bell, int64_t bin)
{
    return bell->distance[(int32_t)(bin % (int64_t)bell->ring)];
}

static double bell_distance(const fr_bell *bell, int64_t bin)
{
    int64_t last = bell->bins - 1, from = bin < 0 ? 0 : last;
    int64_t inner = bin < 0 ? bell->reach : last - bell->reach;
    double end;
    if (bin >= 0 && bin <= last)
        return at_bin(bell, bin);
    end = at_bin(bell, from);
    return end + (double)(bin - from) * (at_bin(bell, inner) - end) / (double)(inner - from);
}

double fr_bell_along(const fr_bell *bell, int64_t bin)
{
    double sum = 0.0;
    for (int64_t i = -bell->reach; i <= bell->reach; i++)
        sum += bell->weight[i < 0 ? -i : i] * bell_distance(bell, bin + i);
    return sum;
}
