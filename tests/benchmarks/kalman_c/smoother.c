/* Forward over all samples, back over the nodes, and how sure that is. */
#include "kalman.h"

#include <stdlib.h>
#include <string.h>

static void close_node(Node *node, const Filter *k, int64_t at, const double *before, int64_t done)
{
    node->at = at;
    node->updates = done;
    node->rise = k->x[R] - before[R];
    node->climb = k->x[V] - before[V];
    memcpy(node->p, k->p, sizeof node->p);
}

static int64_t forward(const Model *m, int64_t size, const double *const u[6],
                       const Observations *seen, double *height, Node *nodes, Update *updates)
{
    Filter k;
    int64_t count = 0, observed = 0, done = 0, sub_block = (int64_t)m->sub_block;
    begin_filter(&k, m);
    for (int j = 0; j < 6; j++)
        k.input[j] = u[j][0];
    begin_sub_block(&k);
    height[0] = k.x[R];
    for (int64_t begin = 0, end; begin < size; begin = end + 1) {
        Node *node = &nodes[count++];
        end = begin + (sub_block - begin % sub_block) % sub_block;
        if (observed < seen->count && seen->at[observed] < end)
            end = seen->at[observed];
        if (end > size - 1)
            end = size - 1;
        advance_states(&k, m, u, begin > 0 ? begin : 1, end + 1, height);
        double before[2] = {k.x[R], k.x[V]};
        keep_transition(&k, m, node);
        predict_covariance(&k, m);
        if (observed < seen->count && seen->at[observed] == end) {
            done += observe_at_node(&k, m, u, end, (int)seen->mark[observed],
                                    seen->row[observed], node, updates + done);
            height[end] = k.x[R];
            observed++;
        }
        close_node(node, &k, end, before, done);
        begin_sub_block(&k);
    }
    return count;
}

int64_t kalman_smoother(const Model *m, int64_t size, const double *const u[7],
                        const Observations *seen, double *height, double *sigma)
{
    size_t room = (size_t)(size / (int64_t)m->sub_block + seen->count + 2);
    Node *nodes = malloc(room * sizeof *nodes);
    Update *updates = malloc(((size_t)seen->count * KINDS + 1) * sizeof *updates);
    Correction *found = malloc(room * sizeof *found);
    int64_t count = -1;
    if (nodes && updates && found) {
        count = forward(m, size, u, seen, height, nodes, updates);
        smooth_heights(nodes, count, updates, m->step, found, height);
        if (tell_uncertainty(m, nodes, count, updates, u[6], size, sigma) < 0)
            count = -1;
    }
    free(found);
    free(updates);
    free(nodes);
    return count;
}
