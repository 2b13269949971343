"""A row of docs/performance-here.md: which command measures it, and where that prints it.

A row reads its numbers from what its benchmark printed, so that a table needs no second copy of
them. `figures.py` has the rows.
"""

import operator
import re
from dataclasses import dataclass

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
    command: str, what: str, most: float | None = None, seconds: float | None = None
) -> tuple[Row, Row]:
    """Return rows of the memory and the time of an hour from disk."""
    return (
        Row(
            command,
            f"an hour from disk, {what}: peak memory beyond the profile and its 1-σ",
            rf"beyond profile +{NUMBER} MB",
            ("{0} MB", "–", "–"),
            None if most is None else (0, "≤", most),
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


def simulated(what: str) -> Row:
    """Return a row of the simulation, the drive of its first row with more in it."""
    pattern = rf"^the first with {what}: [^\n]*? {NUMBER} x real time[^\n]* {NUMBER} of the peer"
    cells = "{0} × real time", "the vehicle alone in numpy", "{1}"
    return Row("simulation", f"the same with {what}", pattern, cells, (0, "≥", 60.0))


def five_seconds(
    command: str, name: str, cold_s: float | None, compiled_s: float | None
) -> list[Row]:
    """Return rows of `floatref process` on five seconds of driving, cold and compiled."""
    return [
        Row(
            command,
            f"`floatref process`, 5 s, `{name}`: {state}",
            rf"^  {state} +{NUMBER} s, +{NUMBER} s of the processor",
            ("{0} s, {1} s of the processor", "–", "–"),
            None if most is None else (0, "≤", most),
        )
        for state, most in (("nothing compiled", cold_s), ("compiled", compiled_s))
    ]


def from_fixed_interval(command: str, what: str, most_um: float | None = None) -> Row:
    """Return a row of how far a smoother is from one that waits for the last reading."""
    pattern = rf"left +furthest from the fixed interval +{NUMBER} µm"
    goal = None if most_um is None else (0, "≤", most_um)
    label = f"{what}, 360 s, left path: from the fixed interval"
    return Row(command, label, pattern, ("{0} µm", "–", "–"), goal)


def kalman(drive: str, plan: str) -> Row:
    """Return a row of the Kalman stage beside C."""
    pattern = rf"^{drive}, .*?^  {plan}, C{SPEED}.*?^    stage{SPEED} +ratio +{NUMBER}"
    cells = "{2} ns/sample, {3} × real time", "C, {0} ns/sample", "{4}"
    return Row("kalman", f"`{plan}`, the stage, {drive}", pattern, cells, (4, "≤", 1.6))
