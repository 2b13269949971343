"""The figures of docs/performance-here.md, in its order.

`write_figures.py` runs their commands, and `performance_pages.py` writes the table.
"""

from collections.abc import Mapping

from figure_rows import (
    NUMBER,
    SPEED,
    TIMES,
    Row,
    beside,
    first,
    five_seconds,
    from_fixed_interval,
    hour,
    in_c,
    kalman,
    of_peer,
    pipeline,
    simulated,
)

ROWS = (
    beside("filters", "zero-phase third-order high-pass, both passes", "floatref",
           "sosfilt, twice", "ns/point", 0.6),
    beside("varying", "the same with a cut-off from the speed, on whole arrays",
           "on arrays  floatref", "sosfiltfilt, fixed", "ns/sample", 0.65),
    beside("varying", "that as stages, block by block", "as stages  floatref",
           "sosfiltfilt, fixed", "ns/sample", None),
    beside("iri", "IRI of 100 km at 5.08 mm", "floatref", "lfilter", "ns/point", 0.6),
    beside("iri", "cross correlation, ±196 lags", "196 lags\n  floatref", "correlate, FFT", "ms",
           None),
    beside("iri", "cross correlation, ±1,968 lags", "1968 lags\n  floatref", "correlate, FFT",
           "ms", None),
    *map(in_c, ("HPF_B3S1", "varying, sections 12", "matched high-pass", "IRI, per point",
                "adaptive set")),
    kalman("72 km/h", "kalman-smoother"),
    kalman("stop", "kalman-smoother-reflection"),
    Row("kalman", "`kalman-smoother-reflection`, in memory, a stop", rf"^stop, .*?^  whole{SPEED}",
        (TIMES, "–", "–"), (1, "≥", 956.0)),
    Row("kalman", "the same, 72 km/h", rf"^72 km/h, .*?^  whole{SPEED}", (TIMES, "–", "–"),
        (1, "≥", 956.0)),
    of_peer("kalman", "filterpy", "the same filter, a few seconds", 400.0),
    of_peer("kalman", "JAX scan", "the same filter, a few seconds", 100.0),
    *five_seconds("kalman", "kalman-smoother-reflection", 15.0, 3.0),
    from_fixed_interval("hour-kalman", "`kalman-smoother-reflection`", 10.0),
    Row("road", "`road-prior-smoother`, the stage, 72 km/h", rf"^72 km/h.*?^  stage{SPEED}",
        (TIMES, "–", "–"), (1, "≥", 300.0)),
    Row("road", "`road-prior-smoother`, in memory, 72 km/h",
        rf"^72 km/h.*?^  road-prior-smoother{SPEED}", (TIMES, "–", "–"), (1, "≥", 1240.0)),
    Row("road", "the same with a stop in each kilometre",
        rf"one in each kilometre.*?^  road-prior-smoother{SPEED}", (TIMES, "–", "–"),
        (1, "≥", 450.0)),
    Row("road", "its levelling alone", rf"^  levelling{SPEED}", (TIMES, "–", "–"),
        (1, "≥", 800.0)),
    of_peer("road", "literal reference", "the same smoother, four seconds of a stop"),
    of_peer("road", "filterpy", "the same smoother, four seconds of a stop"),
    *five_seconds("road", "road-prior-smoother", None, None),
    from_fixed_interval("hour-road", "`road-prior-smoother`"),
    Row("joint", "a step of the joint input-state filter",
        rf"floatref +{NUMBER} ns/step.*?numpy[^\n]*? {NUMBER} ns/step +ratio {NUMBER}",
        ("{0} ns", "numpy, {1} ns", "{2}")),
    Row("joint", "the same",
        rf"floatref +{NUMBER} ns/step.*?filterpy, [^\n]*? {NUMBER} ns/step +ratio {NUMBER}",
        ("{0} ns", "filterpy, {1} ns", "{2}")),
    pipeline("temporal-basic", 300.0),
    *map(pipeline, ("temporal-mean-removal", "temporal-hpf", "temporal-hpf-local-suppression",
                    "temporal-adaptive-hpf")),
    pipeline("temporal-adaptive-hpf-spatial-backward", 500.0),
    *map(pipeline, ("temporal-matched-hpf", "spatial-basic", "spatial-hpf",
                    "spatial-hpf-timer-distortion", "spatial-hpf-timer-distortion-reflection",
                    "road-prior-smoother-spatial", "response-joint-input-state",
                    "response-observer")),
    *hour("hour", "adaptive", 300.0),
    *hour("hour-road", "road prior", 300.0, 30.0),
    *hour("hour-kalman", "Kalman"),
    Row("simulation", "simulation, two wheel paths, all channels",
        rf"^ref_72, two tracks[^\n]*? {NUMBER} x real time[^\n]* {NUMBER} of the peer",
        ("{0} × real time", "the vehicle alone in numpy", "{1}"), (0, "≥", 60.0)),
    *map(simulated, ("crown, joints and patches", "friction and progressive springs",
                     "wander on a surface", "line laser of 100 mm", "radius, warming, latency",
                     "all encoders", "all of these")),
    Row("judge", "`conformance run`, recommended pipeline", rf"quick: {NUMBER} s, {NUMBER} cases",
        ("{0} s, {1} cases", "–", "–"), (0, "<", 120.0)),
    *(
        first(f"`floatref process`, 3.6 min, {what}: {state}", f"{pipeline}, {state}", most)
        for pipeline, what in (
            ("road-prior-smoother", "road prior"),
            ("temporal-adaptive-hpf-spatial-backward", "adaptive"),
            ("kalman-smoother-reflection", "Kalman"),
        )
        for state, most in (("nothing compiled", 5.0), ("compiled", 1.0), ("start-up", 0.4))
    ),
    Row("verdict", "the README's first command, nothing compiled, nothing simulated",
        rf"conformance run --seed 0 +{NUMBER} s, +{NUMBER} s of the processor",
        ("{0} s, {1} s of the processor", "–", "–"), (1, "≤", 45.0)),
    Row("startup", "`floatref --help`, whole process", rf"floatref --help +{NUMBER} s",
        ("{0} s", "–", "–"), (0, "<", 0.5)),
    Row("startup", "`import floatref`, whole process", rf"import floatref +{NUMBER} s",
        ("{0} s", "–", "–")),
    Row("retrofit", "`AdaptiveHighPass`, three calls on 10 ms",
        rf"AdaptiveHighPass, three calls +{NUMBER} us, loop alone +{NUMBER} us",
        ("{0} µs", "the loop alone, {1} µs", "–")),
)  # fmt: skip


def table(printed: Mapping[str, str]) -> list[tuple[str, ...]]:
    """Return the lines of all rows whose command has been run.

    A peer that is not installed is left out, as its benchmark does.
    """
    rows = [row for row in ROWS if row.command in printed]
    absent = [row for row in rows if row.found(printed[row.command]) is None]
    return [row.line(printed[row.command]) for row in rows if row not in absent or not peer(row)]


def peer(row: Row) -> bool:
    """Return whether a row is of a package that may be missing."""
    return any(name in row.pattern for name in ("filterpy", "JAX"))
