/* SPDX-License-Identifier: Apache-2.0
 *
 * How sure the output is: 1-sigma behind HPF_B3x2, and what readings to come may change.
 */
#ifndef FR_LAG_SIGMA_H
#define FR_LAG_SIGMA_H

#include "lag_link.h"

/* Write (I - Lambda P) e_r into all marks that are held, nothing known behind the last. */
void fr_lag_settle(const fr_lag_view *view);

/* Write 1-sigma into marks `begin` to `end - 1` and the one before, at which the line to the first
 * begins; and by how much readings to come, unless the run has ended, may change them. A point whose
 * high-pass takes in one that has come out too early is in doubt as well. */
void fr_lag_sigmas(const fr_lag_view *view, int64_t begin, int64_t end, int ended);

#endif
