/* SPDX-License-Identifier: Apache-2.0
 *
 * The adjoint lambda, back from mark to mark or from node to node.
 */
#include <string.h>

#include "lag_back.h"
#include "lag_link.h"

/* lambda <- Psi' lambda + pushed. */
static void back_mark(const fr_lag_view *view, int64_t number, double *lambda)
{
    int32_t states = view->model->states;
    fr_lag_mark *mark = fr_lag_mark_at(view, number);
    const double *pushed = fr_lag_pushed(view, mark);
    double turned[FR_LAG_STATES];
    fr_lag_turn(fr_lag_passed(view, mark), lambda, states, turned);
    for (int32_t i = 0; i < states; i++)
        lambda[i] = turned[i] + pushed[i];
}

void fr_lag_back_marks(const fr_lag_view *view, int64_t end, double *lambda)
{
    for (int64_t k = view->lag->marks - 1; k >= end; k--)
        back_mark(view, k, lambda);
}

fr_lag_correction fr_lag_correct(const double *rows, int32_t states, const double *lambda)
{
    fr_lag_correction found = {0.0, 0.0};
    for (int32_t j = 0; j < states; j++) {
        found.height -= rows[j] * lambda[j];
        found.velocity -= rows[states + j] * lambda[j];
    }
    return found;
}

/* lambda <- (I - K H)' lambda - H' (y - h) / S. */
static void back_update(const fr_lag_model *model, const double *update, double *lambda)
{
    const double *row = fr_lag_row(model, update);
    double total = update[0];
    for (int32_t j = 0; j < model->states; j++)
        total += update[2 + j] * lambda[j];
    for (int32_t j = 0; j < model->states; j++)
        lambda[j] -= row[j] * total;
}

static void back_node(const fr_lag_view *view, int32_t place, fr_lag_node *node,
                      int32_t first_update, double *lambda)
{
    double *rows = fr_lag_rows(node);
    fr_lag_correction found = fr_lag_correct(rows, view->model->states, lambda);
    rows[0] = found.height;
    rows[1] = found.velocity;
    if (node->mark >= 0) {
        back_mark(view, node->mark, lambda);
        return;
    }
    for (int32_t m = node->updates - 1; m >= first_update; m--)
        back_update(view->model, fr_lag_update_at(view, place, m), lambda);
    view->model->back(fr_lag_own(view, node), node->span, lambda);
}

void fr_lag_back_nodes(const fr_lag_view *view, int32_t place, double *lambda)
{
    for (int32_t k = view->lag->sections[place].nodes - 1; k >= 0; k--) {
        int32_t first = k > 0 ? fr_lag_node_at(view, place, k - 1)->updates : 0;
        back_node(view, place, fr_lag_node_at(view, place, k), first, lambda);
    }
}
