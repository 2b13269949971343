"""Print what each stage of the C library costs on a small core, as tables of the documentation.

python .ci/embedded/costs.py [STAGE ...]

They are those of docs/embedded.md and, of smoothers, docs/embedded-smoothers.md. Rows are stages
of ``stages_of_...c``. What the header declares and no stage measures is listed below the tables, so
that a new object or function is not forgotten. Without the tools it says so in a line.
"""

import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import board
import cycles
import stack

CLOCK_HZ = 168e6
LARGE_CLOCK_HZ = 480e6
"""Of a Cortex-M7, which is taken to need a cycle for an instruction."""
SHARE = 0.5
"""Part of the time of the processor that the stages may take; drivers and files need the rest."""
POINTS_PER_S = 800.0
"""Points of 25 mm at 20 m/s, which is the speed of the signals."""
BINS_PER_S = 100.0
OVER_POINTS: tuple[str, ...] = (
    "adaptive_end",
    "timer_distortion_steps",
    "time_step",
    "integral_steps",
)
OVER_POINTS += ("integral_reflecting", "cut_off_wave_number", "iri")
OVER_POINTS += tuple(board.stages([board.HERE / "stages_of_profiles.c"]))
"""Stages whose samples are points, whatever the rate is."""
SMOOTHERS = tuple(board.stages(board.SMOOTHERS))
UNTRACED = ("level_fit_8_s",)
"""Stages with too many instructions for a look at each of them."""


@dataclass(frozen=True)
class Row:
    """The costs of a stage: bytes of text, data and stack, its figures and cycles by rate in Hz."""

    stage: str
    text: int
    data: int
    stack: int
    figures: dict[int, board.Figures]
    estimates: dict[int, cycles.Cost]

    @property
    def per(self) -> str:
        """What its samples are, where they are not those of the sensors."""
        if self.stage.startswith("level_fit"):
            return ", per bin"
        return ", per point" if self.stage in OVER_POINTS else ""

    def each_s(self, rate: int) -> float:
        """Return how many of its samples there are in a second."""
        return {", per bin": BINS_PER_S, ", per point": POINTS_PER_S}.get(self.per, rate)

    def cycles(self, rate: int) -> tuple[float, float]:
        """Return the fewest and the most cycles of a sample.

        A short run is traced, in which windows may not be full: a long one has as many for an
        instruction.
        """
        cost = self.estimates[rate]
        scale = self.figures[rate].instructions / cost.instructions
        return scale * cost.fewest, scale * cost.most

    def wheel_paths(self, rate: int) -> int:
        """Return for how many wheel paths a processor of ``CLOCK_HZ`` has the time, at most."""
        return int(SHARE * CLOCK_HZ / (self.cycles(rate)[1] * self.each_s(rate)))

    def time(self, rate: int) -> float:
        """Return the share of a whole processor: of the small one by the most cycles."""
        if self.estimates:
            return self.cycles(rate)[1] * self.each_s(rate) / CLOCK_HZ
        return self.figures[rate].instructions * self.each_s(rate) / LARGE_CLOCK_HZ


def row(core: board.Board, stage: str, empty: tuple[int, int], traced: bool) -> Row:
    """Measure a stage; ``empty`` is what the harness takes itself."""
    image = core.image(stage)
    text, data = (a - b for a, b in zip(core.sizes(image), empty, strict=True))
    figures = {each.rate: each for each in core.run(image)}
    deepest = stack.deepest(image, core.folder)
    looked_at = traced and stage not in UNTRACED
    return Row(
        stage, text, data, deepest, figures, cycles.estimate(core, stage) if looked_at else {}
    )


Column = Callable[[Row, int], str]
"""What a cell shows of a row at a rate in Hz."""


CELLS: dict[str, Column] = {
    "object": lambda row, rate: f"{row.figures[rate].bytes}",
    "instructions": lambda row, rate: f"{row.figures[rate].instructions:.0f}",
    "longest push, 10⁶": lambda row, rate: f"{row.figures[rate].longest_push / 1e6:.2f}",
    "cycles": lambda row, rate: f"{row.cycles(rate)[0]:.0f}–{row.cycles(rate)[1]:.0f}",
    "wheel paths": lambda row, rate: f"{row.wheel_paths(rate)}",
    "% of 168 MHz": lambda row, rate: f"{100.0 * row.time(rate):.3g}",
    "% of 480 MHz": lambda row, rate: f"{100.0 * row.time(rate):.3g}",
}


def columns_of(smoothers: bool, traced: bool) -> list[str]:
    """Return the columns behind the stack: of stages, or of smoothers."""
    if not smoothers:
        return ["instructions", *(("cycles", "wheel paths") if traced else ())]
    counted = ["instructions", "longest push, 10⁶"]
    return [*counted, *(("cycles", "% of 168 MHz") if traced else ("% of 480 MHz",))]


def cell(row: Row, column: str) -> str:
    """Return what a column shows at all rates, once where it is the same."""
    if not row.estimates and column in ("cycles", "% of 168 MHz"):
        return "–"
    shown = [CELLS[column](row, rate) for rate in sorted(row.figures)]
    return shown[0] if len(set(shown)) == 1 else ", ".join(shown)


def table(rows: Sequence[Row], traced: bool) -> str:
    """Return a table of text, memory, instructions and what they take of a processor."""
    columns = columns_of(rows[0].stage in SMOOTHERS, traced)
    head = ["stage", "text", "data", "object", "stack", *columns]
    lines = [f"| {' | '.join(head)} |", f"|---|{'---:|' * (len(head) - 1)}"]
    for each in rows:
        cells = [f"`{each.stage}`{each.per}", each.text, each.data, cell(each, "object")]
        cells += [each.stack, *(cell(each, column) for column in columns)]
        lines.append(f"| {' | '.join(map(str, cells))} |")
    return "\n".join(lines)


def unmeasured() -> list[str]:
    """Return the objects and functions of the header that no stage measures."""
    measured = {board.stage_kind(stage) for stage in board.stages()}
    return [f"`fr_{kind}`" for kind in board.kinds() if kind not in measured]


def main(chosen: Sequence[str]) -> int:
    """Print both tables."""
    missing = board.missing_tools()
    if missing:
        print(f"costs on a small core: skipped, {', '.join(missing)} is not installed")
        return 0
    unknown = [name for name in chosen if name not in board.stages()]
    if unknown:
        print(f"{', '.join(unknown)}: no such stage; there are {', '.join(board.stages())}")
        return 2
    names = list(chosen) or board.stages()
    plain = [name for name in names if name not in SMOOTHERS]
    smoothers = [name for name in names if name in SMOOTHERS]
    with tempfile.TemporaryDirectory(prefix="floatref-embedded-") as folder:
        for title, target in (("Cortex-M4F, float", board.M4F), ("Cortex-M7, double", board.M7)):
            core = board.Board(target, Path(folder) / target.machine)
            empty = core.sizes(core.image("nothing"))
            traced = target is board.M4F
            for page, of_page in (("", plain), (" smoothers", smoothers)):
                rows = [row(core, stage, empty, traced) for stage in of_page]
                if rows:
                    print(f"\n{title}{page}:\n\n{table(rows, traced)}", flush=True)
    print(f"\nNot measured: {', '.join(unmeasured()) or 'nothing'}.")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
