/* Multi-rate extended Kalman filter and Bryson-Frazier smoother of one wheel path.
 *
 * States: height, velocity, pitch, roll, biases of acceleration, roll rate and pitch rate, lean of
 * the vertical accelerometer's axis, drift of the GNSS height, and minus what the height is off by
 * where a stop begins. SI units.
 */
#ifndef KALMAN_H
#define KALMAN_H

#include <stdint.h>

enum { STATES = 10, KINDS = 4, COLUMNS = 4, OBSERVATION = 2 * KINDS + 1 };
enum { R, V, PITCH, ROLL, BIAS, ROLL_BIAS, PITCH_BIAS, LEAN, DRIFT, OFFSET };
enum { RELATIVE = 1, CAPTURE = 2, TRUSTED = 4, REFLECTED = 8, RENEW = 16, FORGET = 32 };

extern const int COLUMN[COLUMNS];

/* What the caller says of sensors and sub-blocks; process holds squares of densities, datum
 * and lean the variances of new ones, wavelength the cut-off of the delivered elevation. */
typedef struct {
    double step, gravity, arm[3], process[7], datum, floor[KINDS], lean;
    double start[STATES], variance[STATES], sub_block, wavelength, noise;
} Model;

/* Samples, marks, and rows of values, variances, and variance that the drift gains. */
typedef struct {
    int64_t count;
    const int64_t *at, *mark;
    const double (*row)[OBSERVATION];
} Observations;

/* Transition since the last node, as far as it is neither 0, 1 nor a power of the time. */
typedef struct {
    double r[COLUMNS], v[COLUMNS], pitch[COLUMNS], roll[COLUMNS], r_lean, v_lean;
} Transition;

/* `renewed` is the state that is another from here on, and `shift` how much of a lean given up the
 * bias of the acceleration takes over. */
typedef struct {
    Transition f;
    int64_t at, updates;
    int renewed;
    double shift, rise, climb, p[2][STATES];
} Node;

typedef struct {
    double h[STATES], gain[STATES], innovation, weight;
} Update;

/* Height and velocity on both sides of a node's updates. */
typedef struct {
    double r, v, r_behind, v_behind;
} Correction;

typedef struct {
    double x[STATES], p[STATES][STATES];
    Transition f;
    double input[6], sine[2], cosine[2], by_pitch, by_roll;
    double captured, origin, level, running;
    int64_t steps, in_a_row;
} Filter;

void begin_filter(Filter *k, const Model *m);
void begin_sub_block(Filter *k);
void keep_transition(Filter *k, const Model *m, Node *node);
void advance_states(Filter *k, const Model *m, const double *const u[6], int64_t begin,
                    int64_t end, double *height);
void predict_covariance(Filter *k, const Model *m);
int observe_at_node(Filter *k, const Model *m, const double *const u[6], int64_t i, int mark,
                    const double *row, Node *node, Update *updates);
void smooth_heights(const Node *nodes, int64_t count, const Update *updates, double step,
                    Correction *found, double *height);
int tell_uncertainty(const Model *m, const Node *nodes, int64_t count, const Update *updates,
                     const double *distance, int64_t size, double *sigma);

/* Write the smoothed height of `size` samples, and 1-sigma of the delivered elevation; the seven
 * inputs are specific force and angular rate along the body's axes, and the distance travelled.
 * Returns the number of nodes, or -1 if there is no memory for them. */
int64_t kalman_smoother(const Model *m, int64_t size, const double *const u[7],
                        const Observations *seen, double *height, double *sigma);

#endif
