/* The Bryson-Frazier backward pass, and its correction of every sample's height. */
#include "kalman.h"

static Correction correction_of(const Node *node, const double *adjoint)
{
    Correction c = {0};
    for (int j = 0; j < STATES; j++) {
        c.r_behind -= node->p[R][j] * adjoint[j];
        c.v_behind -= node->p[V][j] * adjoint[j];
    }
    c.r = c.r_behind + node->rise;
    c.v = c.v_behind + node->climb;
    return c;
}

/* Lambda <- (I - K H)' lambda - H' (y - h) / S. */
static void undo(const Update *update, double *adjoint)
{
    double total = update->innovation;
    for (int j = 0; j < STATES; j++)
        total += update->gain[j] * adjoint[j];
    for (int j = 0; j < STATES; j++)
        adjoint[j] -= update->h[j] * total;
}

/* Lambda <- F' lambda over `span` in s. */
static void back(const Transition *f, double span, double *adjoint)
{
    double r = adjoint[R], v = adjoint[V], pitch = adjoint[PITCH], roll = adjoint[ROLL];
    adjoint[V] += span * r;
    adjoint[BIAS] += span * v + 0.5 * span * span * r;
    adjoint[LEAN] += r * f->r_lean + v * f->v_lean;
    adjoint[PITCH] = adjoint[ROLL] = 0.0;
    for (int j = 0; j < COLUMNS; j++)
        adjoint[COLUMN[j]] += r * f->r[j] + v * f->v[j] + pitch * f->pitch[j] + roll * f->roll[j];
}

/* Go back over all nodes, from the last to the first sample. */
static void correct(const Node *nodes, int64_t count, const Update *updates, double step,
                    Correction *found)
{
    double adjoint[STATES] = {0};
    for (int64_t k = count - 1; k >= 0; k--) {
        const Node *node = &nodes[k];
        int64_t low = k > 0 ? nodes[k - 1].updates : 0, earlier = k > 0 ? nodes[k - 1].at : 0;
        found[k] = correction_of(node, adjoint);
        for (int64_t m = node->updates - 1; m >= low; m--)
            undo(&updates[m], adjoint);
        if (node->renewed == LEAN) {
            adjoint[LEAN] = node->shift * adjoint[BIAS];
        } else if (node->renewed == OFFSET) {
            adjoint[R] -= adjoint[OFFSET];
            adjoint[OFFSET] = 0.0;
        }
        back(&node->f, (double)(node->at - earlier) * step, adjoint);
    }
}

/* Add the cubic of values and slopes at the ends between any two nodes. */
static void interpolate(const Node *nodes, int64_t count, const Correction *found, double step,
                        double *restrict height)
{
    int64_t begin = 0;
    double r0 = 0.0, v0 = 0.0;
    for (int64_t k = 0; k < count; k++) {
        int64_t end = nodes[k].at;
        double span = (double)(end - begin) * step, rise = found[k].r - r0;
        double slope0 = span * v0, slope1 = span * found[k].v;
        double square = 3.0 * rise - 2.0 * slope0 - slope1, cube = slope0 + slope1 - 2.0 * rise;
        double scale = 1.0 / (double)(end > begin ? end - begin : 1);
        double *at = height + begin;
        for (int64_t i = 0; i < end - begin; i++) {
            double t = (double)(int)i * scale;
            at[i] += r0 + t * (slope0 + t * (square + t * cube));
        }
        begin = end;
        r0 = found[k].r_behind;
        v0 = found[k].v_behind;
    }
    height[begin] += r0;
}

void smooth_heights(const Node *nodes, int64_t count, const Update *updates, double step,
                    Correction *found, double *height)
{
    correct(nodes, count, updates, step, found);
    interpolate(nodes, count, found, step, height);
}
