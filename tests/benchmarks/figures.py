"""The figures of docs/performance-here.md: which command measures each, and where it prints it.

A row reads its numbers from what its benchmark printed, so that a table needs no second copy of
them. `write_figures.py` runs the commands, and `performance_pages.py` writes the table.
"""

import operator
import re
from collections.abc import Mapping
from dataclasses import dataclass

PYTHON = "python tests/benchmarks/"
COMMANDS = {
    "filters": "bench_filters.py",
    "varying": "bench_varying.py",
    "iri": "bench_iri.py",
    "startup": "bench_startup.py",
    "retrofit": "bench_retrofit.py",
    "joint": "bench_joint_filter.py",
    "c": "bench_c_library.py",
    "pipelines": "bench_pipelines.py",
    "simulation": "bench_simulation.py",
    "first": "bench_first_second.py",
    "verdict": "bench_first_second.py --verdict",
    "kalman": "bench_kalman.py",
    "road": "bench_road_prior.py",
    "hour": "bench_memory.py",
    "hour-road": "bench_kalman_memory.py --pipeline road-prior-smoother",
    "hour-kalman": "bench_kalman_memory.py",
    "judge": "bench_judge.py",
    "growth": "bench_growth.py --json docs/data/growth.json --plot docs/images/growth.png",
}
"""Benchmarks by short names, the quick ones first. The last writes files of its own."""
COMPARE = {"≤": operator.le, "≥": operator.ge, "<": operator.lt}
NUMBER = r"([\d.]+)"
SPEED = rf" +{NUMBER} ns/sample +{NUMBER} x real time"
TIMES = "{0} ns/sample, {1} × real time"


@dataclass(frozen=True)
class Row:
    """A row: its command, what it measures, where that is printed, and how its cells show it.

    Cells are the measurement, the peer and the ratio, with the groups of the pattern in braces.
    """

    command: str
    what: str
    pattern: str
    cells: tuple[str, str, str]
    aim: tuple[int, str, float] | None = None
    """The group, the relation and the value that it should have."""

    def found(self, text: str) -> tuple[str, ...] | None:
        """Return the groups of the pattern in what the benchmark printed."""
        match = re.search(self.pattern, text, re.MULTILINE | re.DOTALL)
        return match.groups() if match else None

    def line(self, text: str) -> tuple[str, ...]:
        """Return the cells of the table; ValueError where the benchmark did not print them."""
        groups = self.found(text)
        if groups is None:
            raise ValueError(f"{COMMANDS[self.command]} does not print {self.pattern!r}")
        cells = [cell.format(*groups) for cell in self.cells]
        return self.what, *cells, *self.judged(groups), f"`{COMMANDS[self.command]}`"

    def judged(self, groups: tuple[str, ...]) -> tuple[str, str]:
        """Return the aim, and whether it is met."""
        if self.aim is None:
            return "–", "–"
        group, relation, value = self.aim
        met = COMPARE[relation](float(groups[group]), value)
        return f"{relation} {value:g}", "yes" if met else "**no**"


def beside(command: str, what: str, ours: str, peer: str, unit: str, aim: float | None) -> Row:
    """Return a row of a time beside that of a peer, whose ratio is printed behind it."""
    name = peer.partition(",")[0]
    pattern = rf"{ours} +{NUMBER} {unit}.*?{name}[^\n]*? {NUMBER} {unit} +ratio {NUMBER}"
    goal = None if aim is None else (2, "≤", aim)
    return Row(command, what, pattern, (f"{{0}} {unit}", f"`{peer}`, {{1}} {unit}", "{2}"), goal)


def in_c(stage: str) -> Row:
    """Return a row of a stage of the C library beside the kernels, in double."""
    pattern = rf"^  {stage} +{NUMBER} +{NUMBER} +{NUMBER} +{NUMBER} +{NUMBER}$"
    cells = "{0} ns/sample", "kernels of the SDK, {2} ns/sample", "{3}"
    return Row("c", f"libfloatref: {stage}", pattern, cells, (3, "≤", 1.0))


def pipeline(name: str, aim: float | None = None) -> Row:
    """Return a row of a pipeline in memory."""
    pattern = rf"^  {name} +{NUMBER} s +{NUMBER} x real time"
    goal = None if aim is None else (1, "≥", aim)
    return Row("pipelines", f"`{name}`, in memory", pattern, ("{1} × real time", "–", "–"), goal)


def of_peer(command: str, peer: str, label: str, aim: float | None = None) -> Row:
    """Return a row of a peer whose time is printed as a multiple of ours."""
    pattern = rf"^  {peer} +{NUMBER} ns/sample +{NUMBER} of ours, (\S+) m apart"
    goal = None if aim is None else (1, "≥", aim)
    cells = "{2} m apart", f"{peer}, {{0}} ns/sample", "1 : {1}"
    return Row(command, label, pattern, cells, goal)


def hour(
    command: str, what: str, memory: str, most: float, seconds: float | None = None
) -> tuple[Row, Row]:
    """Return rows of the memory and the time of an hour from disk."""
    return (
        Row(
            command,
            f"an hour from disk, {what}: peak memory",
            rf"{memory} +{NUMBER} MB",
            ("{0} MB", "–", "–"),
            (0, "≤", most),
        ),
        Row(
            command,
            f"an hour from disk, {what}",
            rf"wall time +{NUMBER} s +\({NUMBER} x real time",
            ("{0} s, {1} × real time", "–", "–"),
            None if seconds is None else (0, "≤", seconds),
        ),
    )


def first(what: str, pattern: str, most: float) -> Row:
    """Return a row of a whole process: its seconds by the clock, and of the processor."""
    printed = rf"^  {pattern} +{NUMBER} s, +{NUMBER} s of the processor"
    return Row("first", what, printed, ("{0} s, {1} s of the processor", "–", "–"), (0, "≤", most))


def kalman(drive: str, plan: str) -> Row:
    """Return a row of the Kalman stage beside C."""
    pattern = rf"^{drive}, .*?^  {plan}, C{SPEED}.*?^    stage{SPEED} +ratio +{NUMBER}"
    cells = "{2} ns/sample, {3} × real time", "C, {0} ns/sample", "{4}"
    return Row("kalman", f"`{plan}`, the stage, {drive}", pattern, cells, (4, "≤", 1.6))


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
    of_peer("kalman", "filterpy", "the same filter, a few seconds", 400.0),
    of_peer("kalman", "JAX scan", "the same filter, a few seconds", 100.0),
    Row("road", "`road-prior-smoother`, the stage, 72 km/h", rf"^72 km/h.*?^  stage{SPEED}",
        (TIMES, "–", "–"), (1, "≥", 300.0)),
    Row("road", "`road-prior-smoother`, in memory, 72 km/h",
        rf"^72 km/h.*?^  road-prior-smoother{SPEED}", (TIMES, "–", "–"), (1, "≥", 1240.0)),
    Row("road", "the same with a stop in each kilometre",
        rf"one in each kilometre.*?^  road-prior-smoother{SPEED}", (TIMES, "–", "–"),
        (1, "≥", 450.0)),
    of_peer("road", "literal reference", "the same smoother, four seconds of a stop"),
    of_peer("road", "filterpy", "the same smoother, four seconds of a stop"),
    Row("joint", "a step of the joint input-state filter",
        rf"floatref +{NUMBER} ns/step.*?numpy[^\n]*? {NUMBER} ns/step +ratio {NUMBER}",
        ("{0} ns", "numpy, {1} ns", "{2}")),
    Row("joint", "the same",
        rf"floatref +{NUMBER} ns/step.*?filterpy, [^\n]*? {NUMBER} ns/step +ratio {NUMBER}",
        ("{0} ns", "filterpy, {1} ns", "{2}")),
    pipeline("temporal-basic", 300.0),
    *map(pipeline, ("temporal-mean-removal", "temporal-hpf", "temporal-adaptive-hpf")),
    pipeline("temporal-adaptive-hpf-spatial-backward", 500.0),
    *map(pipeline, ("temporal-matched-hpf", "spatial-basic", "spatial-hpf",
                    "response-joint-input-state", "response-observer")),
    *hour("hour", "adaptive, beyond the profile", "beyond profile", 300.0),
    *hour("hour-road", "road prior", "peak resident", 300.0, 30.0),
    *hour("hour-kalman", "Kalman", "peak resident", 1000.0),
    Row("simulation", "simulation, two wheel paths, all channels",
        rf"^ref_72, two tracks[^\n]*? {NUMBER} x real time[^\n]* {NUMBER} of the peer",
        ("{0} × real time", "the vehicle alone in numpy", "{1}"), (0, "≥", 60.0)),
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
