/* SPDX-License-Identifier: Apache-2.0
 *
 * The sections of a varying cut-off at their start, and across missing samples.
 */
#include "section.h"

/* Keep the sample, or the one before it where it is missing; return whether both are known. */
static int take(fr_section *section, fr_real x, fr_real c)
{
    if (!fr_missing(x)) {
        section->has_x = 1;
        section->x = x;
    }
    section->has_c = section->has_c != 0 || !fr_missing(c) ? 1 : 0;
    return fr_section_started(section);
}

fr_real fr_section_1_any(fr_section *first, fr_real x, fr_real c)
{
    int started = fr_section_started(first);
    if (!started)
        first->c = fr_bridged(c, first->c);
    if (!take(first, x, c))
        return 0;
    if (!started)
        first->r = first->c * first->x;
    return fr_section_1_step(first, first->x, fr_bridged(c, first->c));
}

/* The second sample of (A.15) sees (x1, y1) twice; these states are that past. */
static fr_real start_section_2(fr_section *second)
{
    fr_real x = second->x, c = second->c, a = c + c * c;
    fr_real y = x * (1 + c - 3 * c * c) * (1 / (1 + a));
    second->t = x * (3 * c * c - c);
    second->g = -a * y;
    second->y1 = y;
    second->y2 = y;
    second->a = a;
    return y;
}

fr_real fr_section_2_any(fr_section *second, fr_real x, fr_real c)
{
    int started = fr_section_started(second), ready = take(second, x, c);
    second->c = fr_bridged(c, second->c);
    if (!ready)
        return 0;
    if (!started)
        return start_section_2(second);
    return fr_section_2_step(second, second->x, second->c);
}

fr_real fr_section_12_any(fr_section *first, fr_section *second, fr_real x, fr_real c)
{
    if (!fr_section_started(first) || !fr_section_started(second))
        return fr_section_2_any(second, fr_section_1_any(first, x, c), c);
    first->x = fr_bridged(x, first->x);
    return fr_section_12_step(first, second, first->x, fr_bridged(c, first->c));
}

fr_real fr_section_21_any(fr_section *second, fr_section *first, fr_real x, fr_real c)
{
    if (!fr_section_started(first) || !fr_section_started(second))
        return fr_section_1_any(first, fr_section_2_any(second, x, c), c);
    second->x = fr_bridged(x, second->x);
    second->c = fr_bridged(c, second->c);
    return fr_section_21_step(second, first, second->x, second->c);
}
