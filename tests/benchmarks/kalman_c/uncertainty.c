/* The 1-sigma of the delivered elevation: covariances between marks, seen through the filter. */
#include "kalman.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double APART_M = 8.0, APART_S = 0.5, REACH = 1.5;

/* A node that is told of: what passes on to it from the mark before, and what was seen between. */
typedef struct {
    int64_t at;
    double place, column[STATES], left[STATES];
    double psi[STATES][STATES], seen[STATES][STATES];
} Mark;

static void begin_mark(Mark *mark)
{
    memset(mark, 0, sizeof *mark);
    for (int i = 0; i < STATES; i++)
        mark->psi[i][i] = 1.0;
}

/* Psi <- F Psi over `span` in s. */
static void forth(const Node *node, double span, double psi[STATES][STATES])
{
    const Transition *f = &node->f;
    for (int c = 0; c < STATES; c++) {
        double r = psi[R][c] + span * psi[V][c] + 0.5 * span * span * psi[BIAS][c];
        double v = psi[V][c] + span * psi[BIAS][c], pitch = 0.0, roll = 0.0;
        r += f->r_lean * psi[LEAN][c];
        v += f->v_lean * psi[LEAN][c];
        for (int j = 0; j < COLUMNS; j++) {
            double value = psi[COLUMN[j]][c];
            r += f->r[j] * value;
            v += f->v[j] * value;
            pitch += f->pitch[j] * value;
            roll += f->roll[j] * value;
        }
        psi[R][c] = r;
        psi[V][c] = v;
        psi[PITCH][c] = pitch;
        psi[ROLL][c] = roll;
        if (node->renewed == LEAN) {
            psi[BIAS][c] += node->shift * psi[LEAN][c];
            psi[LEAN][c] = 0.0;
        } else if (node->renewed == OFFSET) {
            psi[OFFSET][c] = -psi[R][c];
        }
    }
}

/* Add Psi' H' H Psi / S to what was seen; Psi <- (I - K H) Psi. */
static void reduce(const Update *update, Mark *mark)
{
    double by[STATES] = {0};
    for (int j = 0; j < STATES; j++)
        for (int c = 0; c < STATES; c++)
            by[c] += update->h[j] * mark->psi[j][c];
    for (int i = 0; i < STATES; i++)
        for (int c = 0; c < STATES; c++) {
            mark->seen[i][c] += by[i] * update->weight * by[c];
            mark->psi[i][c] -= update->gain[i] * by[c];
        }
}

static int64_t choose(const Node *nodes, int64_t count, const Update *updates, double step,
                      const double *distance, Mark *marks)
{
    int64_t found = 0, done = 0;
    double gone = 0.0;
    begin_mark(&marks[0]);
    for (int64_t k = 0; k < count; k++) {
        int64_t earlier = k > 0 ? nodes[k - 1].at : 0;
        double span = (double)(nodes[k].at - earlier) * step, before = floor(gone);
        forth(&nodes[k], span, marks[found].psi);
        for (; done < nodes[k].updates; done++)
            reduce(&updates[done], &marks[found]);
        if (k > 0)
            gone += fmax((distance[nodes[k].at] - distance[earlier]) / APART_M, span / APART_S);
        if (floor(gone) > before || k == count - 1) {
            marks[found].at = nodes[k].at;
            marks[found].place = distance[nodes[k].at];
            memcpy(marks[found].column, nodes[k].p[R], sizeof marks[found].column);
            begin_mark(&marks[++found]);
        }
    }
    return found;
}

/* Product <- a' b. */
static void turned(double a[STATES][STATES], double b[STATES][STATES], double product[STATES][STATES])
{
    for (int i = 0; i < STATES; i++)
        for (int j = 0; j < STATES; j++) {
            double total = 0.0;
            for (int k = 0; k < STATES; k++)
                total += a[k][i] * b[k][j];
            product[i][j] = total;
        }
}

/* Left <- (I - Lambda P) e_r, Lambda going back as Psi' Lambda Psi + what was seen. */
static void settle(Mark *marks, int64_t count)
{
    double known[STATES][STATES] = {{0}}, half[STATES][STATES];
    for (int64_t k = count - 1; k >= 0; k--) {
        for (int i = 0; i < STATES; i++) {
            marks[k].left[i] = i == R;
            for (int j = 0; j < STATES; j++)
                marks[k].left[i] -= known[i][j] * marks[k].column[j];
        }
        turned(known, marks[k].psi, half);
        turned(marks[k].psi, half, known);
        for (int i = 0; i < STATES; i++)
            for (int j = 0; j < STATES; j++)
                known[i][j] += marks[k].seen[i][j];
    }
}

/* Rows of covariances: entry j of row i is that of marks i and i + j, up to `width` apart. */
static void relate(const Mark *marks, int64_t count, double width, int64_t room, double *related)
{
    for (int64_t i = 0; i < count; i++) {
        double moved[STATES];
        memcpy(moved, marks[i].column, sizeof moved);
        for (int64_t j = i; j < count && marks[j].place - marks[i].place <= width; j++) {
            double carried[STATES], total = 0.0;
            for (int s = 0; s < STATES && j > i; s++) {
                carried[s] = 0.0;
                for (int t = 0; t < STATES; t++)
                    carried[s] += marks[j].psi[s][t] * moved[t];
            }
            if (j > i)
                memcpy(moved, carried, sizeof moved);
            for (int s = 0; s < STATES; s++)
                total += marks[j].left[s] * moved[s];
            related[i * room + j - i] = total;
        }
    }
}

/* 1-sigma at mark k of what HPF_B3x2 leaves; `weight` has room for the marks within reach. */
static double deviation(const Mark *marks, int64_t count, int64_t k, const Model *m, int64_t room,
                        const double *related, double *weight)
{
    const double root = sqrt(0.75), cutoff = 2.0 * acos(-1.0) / m->wavelength;
    double reach = REACH * m->wavelength, place = marks[k].place, total = 0.0, variance = 0.0;
    int64_t low = k, end = k;
    while (low > 0 && place - marks[low - 1].place <= reach)
        low--;
    for (end = low; end < count && marks[end].place - place <= reach; end++) {
        int64_t next = end < count - 1 ? end + 1 : end, last = end > 0 ? end - 1 : end;
        double a = cutoff * fabs(marks[end].place - place), b = root * a;
        double response = exp(-a) + exp(-0.5 * a) * (cos(b) + 2.0 * root * sin(b));
        weight[end - low] = (marks[next].place - marks[last].place) * response;
        total += weight[end - low];
    }
    for (int64_t j = low; j < end; j++)
        weight[j - low] = (j == k) - (total > 0.0 ? weight[j - low] / total : 1.0 / (end - low));
    for (int64_t i = low; i < end; i++) {
        double inner = 0.5 * weight[i - low] * related[i * room];
        for (int64_t j = i + 1; j < end; j++)
            inner += weight[j - low] * related[i * room + j - i];
        variance += 2.0 * weight[i - low] * inner;
    }
    return sqrt(fmax(variance, 0.0) + m->noise * m->noise);
}

static void ramp(const Mark *marks, const double *found, int64_t count, int64_t size, double *sigma)
{
    int64_t i = 0;
    while (i < marks[0].at)
        sigma[i++] = found[0];
    for (int64_t k = 0; k + 1 < count; k++) {
        int64_t begin = marks[k].at, end = marks[k + 1].at;
        double slope = (found[k + 1] - found[k]) / (double)(end - begin), *at = sigma + begin;
        for (int64_t j = 0; j < end - begin; j++)
            at[j] = found[k] + (double)(int)j * slope;
        i = end;
    }
    while (i < size)
        sigma[i++] = found[count - 1];
}

/* The most marks that lie within `width` of one. */
static int64_t widest(const Mark *marks, int64_t count, double width)
{
    int64_t most = 0, low = 0;
    for (int64_t k = 0; k < count; k++) {
        while (marks[k].place - marks[low].place > width)
            low++;
        most = k - low + 1 > most ? k - low + 1 : most;
    }
    return most;
}

int tell_uncertainty(const Model *m, const Node *nodes, int64_t count, const Update *updates,
                     const double *distance, int64_t size, double *sigma)
{
    Mark *marks = malloc((size_t)(count + 1) * sizeof *marks);
    if (!marks)
        return -1;
    int64_t told = choose(nodes, count, updates, m->step, distance, marks);
    settle(marks, told);
    double width = 2.0 * REACH * m->wavelength;
    int64_t room = widest(marks, told, width);
    double *related = malloc((size_t)(told * room) * sizeof *related);
    double *found = malloc((size_t)(told + room) * sizeof *found);
    if (related && found) {
        relate(marks, told, width, room, related);
        for (int64_t k = 0; k < told; k++)
            found[k] = deviation(marks, told, k, m, room, related, found + told);
        ramp(marks, found, told, size, sigma);
    }
    int failed = !related || !found;
    free(found);
    free(related);
    free(marks);
    return -failed;
}
