#include "replay.h"

#include <math.h>
#include <string.h>

uint64_t memory[4][8192];
fr_real x[MOST_SIGNALS][MOST_SAMPLES], y[MOST_SAMPLES];
int64_t counts[MOST_SAMPLES];
size_t made;

size_t load(const struct signals *in)
{
    for (int i = 0; i < MOST_SIGNALS; i++)
        for (int k = 0; k < in->count[i]; k++)
            x[i][k] = (fr_real)in->samples[i][k];
    return (size_t)in->count[0];
}

void load_counts(const double *samples, size_t count, double unit)
{
    for (size_t k = 0; k < count; k++)
        counts[k] = (int64_t)rint(samples[k] / unit);
}

fr_status store(struct signals *out, int signal, const fr_real *samples, size_t count)
{
    out->count[signal] = (int)count;
    for (size_t k = 0; k < count; k++)
        out->samples[signal][k] = (double)samples[k];
    return FR_OK;
}

static const struct stage *search_stages(const struct stage *stages, const char *name)
{
    for (; stages->name != NULL; stages++)
        if (strcmp(stages->name, name) == 0)
            return stages;
    return NULL;
}

const struct stage *stage_named(const char *name)
{
    const struct stage *stage = search_stages(SIGNAL_STAGES, name);
    return stage != NULL ? stage : search_stages(PROFILE_STAGES, name);
}
