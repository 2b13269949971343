/* The pitch between brakes is that of a model, which goes on from where levelling has left it. */
#include <math.h>

#include "waiting.h"

fr_status begin_pitch(struct vehicle *vehicle, const struct path *path)
{
    struct waiting *w = vehicle->waiting;
    fr_pitch_config config = fr_pitch_defaults();
    w->room = vehicle->samples / (size_t)w->every + 1;
    if ((w->bins = run_memory(w->room * sizeof *w->bins)) == NULL)
        return FR_TOO_SMALL;
    if (!vehicle->on_levers)
        return FR_OK;
    if ((w->moved = run_memory(w->room * sizeof *w->moved)) == NULL)
        return FR_TOO_SMALL;
    config.rate_hz = path->rate_hz;
    config.metres_per_count = path->metres_per_count;
    config.back = FR_BACK_TAKEN;
    config.missing = FR_MISSING_BRIDGED;
    config.paths = vehicle->paths;
    config.front_m = vehicle->front_m;
    config.rear_m = vehicle->rear_m;
    config.lever_m = vehicle->lever_m;
    return MAKE(pitch, &config, &w->pitch);
}

static fr_status take_pitch(struct waiting *w)
{
    size_t made;
    TRY(fr_pitch_take(w->pitch, w->moved + w->pitched, w->room - w->pitched, &made));
    w->pitched += made;
    return FR_OK;
}

fr_status model_pitch(struct waiting *w, const fr_real *force, const fr_real *height,
                      const int64_t *counts, size_t count)
{
    size_t ready;
    if (w->pitch == NULL)
        return FR_OK;
    TRY(fr_pitch_push(w->pitch, force, height, counts, count, &ready));
    return take_pitch(w);
}

fr_status end_pitch(struct waiting *w)
{
    size_t ready;
    if (w->pitch == NULL)
        return FR_OK;
    TRY(fr_pitch_finish(w->pitch, &ready));
    return take_pitch(w);
}

/* What the model moves the pitch by up to `number`, in place of what it is there. Between bins that
   are level both the pitch itself is known. */
static void join(struct waiting *w, size_t number, bool level)
{
    for (size_t k = w->begun ? w->number + 1 : 0; k <= number; k++) {
        double modelled = w->moved[k];
        w->moved[k] = k == 0 ? modelled : w->moved[k - 1] + (level ? 0.0 : modelled - w->held);
        w->held = modelled;
    }
}

bool next_bin(struct waiting *w)
{
    const fr_level_bin *next = w->bins + w->joined;
    if (w->joined == w->levelled)
        return false;
    size_t number = (size_t)(next->first / w->every);
    if (w->pitch != NULL && number >= w->pitched)
        return false;
    if (w->pitch != NULL)
        join(w, number, w->begun && w->behind.share > 0.0 && next->share > 0.0);
    w->before = w->begun ? w->behind : *next;
    w->behind = *next;
    w->number = number;
    w->begun = true;
    w->joined++;
    return true;
}

double moved_pitch(const struct waiting *w, size_t i)
{
    double every = (double)w->every, last = (double)w->number;
    double place = fmin(fmax(((double)i - 0.5 * (every - 1.0)) / every, 0.0), last);
    if (w->pitch == NULL || !w->begun)
        return 0.0;
    size_t low = (size_t)place, high = low < w->number ? low + 1 : low;
    return w->moved[low] + (place - (double)low) * (w->moved[high] - w->moved[low]);
}
