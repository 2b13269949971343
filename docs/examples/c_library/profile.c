/* From "specific force in m/s^2, height in m, encoder count" per line to a profile and its IRI. */
#include <floatref.h>
#include <stdio.h>

enum { CHUNK = 160, POINTS = 40000 };

static int64_t engine_memory[1024], iri_memory[512];
static fr_real elevation[POINTS], speed[POINTS], trace[POINTS];

static int works(fr_status status)
{
    if (status != FR_OK)
        fprintf(stderr, "%s\n", fr_status_text(status));
    return status == FR_OK;
}

static size_t read_chunk(fr_real *force, fr_real *height, int64_t *counts)
{
    size_t n = 0;
    double a, h;
    long long count;
    while (n < CHUNK && scanf("%lf %lf %lld", &a, &h, &count) == 3) {
        force[n] = (fr_real)a;
        height[n] = (fr_real)h;
        counts[n++] = count;
    }
    return n;
}

int main(void)
{
    fr_adaptive_config config = fr_adaptive_defaults();
    fr_iri_config of_iri = fr_iri_defaults();
    fr_real force[CHUNK], height[CHUNK], m_per_km;
    int64_t counts[CHUNK];
    size_t n, made, points = 0;
    fr_adaptive *engine;
    fr_iri *iri;
    config.travel.rate_hz = 16000.0;
    config.travel.metres_per_count = 0.001;
    config.interval_m = of_iri.interval_m = 0.025;
    config.gravity_mps2 = 9.80665;
    if (!works(fr_adaptive_init(engine_memory, sizeof engine_memory, &config, &engine)) ||
        !works(fr_iri_init(iri_memory, sizeof iri_memory, &of_iri, &iri)))
        return 1;
    while ((n = read_chunk(force, height, counts)) > 0) {
        if (!works(fr_adaptive_push(engine, force, height, counts, n, elevation + points,
                                    speed + points, POINTS - points, &made)))
            return 1;
        points += made;
    }
    if (!works(fr_adaptive_finish(engine, elevation, speed, points, elevation, POINTS, &made)) ||
        !works(fr_iri_push(iri, elevation, points, trace, POINTS, &made)) ||
        !works(fr_iri_finish(iri, trace, POINTS, &made)) || !works(fr_iri_value(iri, &m_per_km)))
        return 1;
    printf("%zu points, IRI %.3f m/km\n", points, m_per_km);
    return 0;
}
