/* SPDX-License-Identifier: Apache-2.0
 *
 * What the backward pass needs of the Kalman filter.
 */
#ifndef FR_KALMAN_BACKWARD_H
#define FR_KALMAN_BACKWARD_H

#include "fixed_lag.h"
#include "kalman.h"

/* Numbers of a node: the state that begins anew, how much of the lean the bias takes over, the
 * transition. */
enum { FR_K_OWN = 20 };

fr_lag_model fr_kalman_lag_model(void);

void fr_kalman_own(const fr_kalman_node *node, double *own);

/* Lambda behind the last node, by what is observed there at the end of a run. */
void fr_kalman_beyond(const fr_kalman_model *model, const fr_kalman_state *state,
                      const fr_kalman_observation *observed, double *lambda);

#endif
