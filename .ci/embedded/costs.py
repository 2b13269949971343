"""Print what each stage of the C library costs on a small core, as the tables of docs/embedded.md.

python .ci/embedded/costs.py [STAGE ...]

Rows are the stages of ``stages.c``. Objects that the header declares and no stage measures are
listed below the tables, so that a new one is not forgotten. Without the tools it says so in a line.
"""

import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import board
import cycles
import stack

CLOCK_HZ = 168e6
SHARE = 0.5
"""Part of the time of the processor that the stages may take; drivers and files need the rest."""
POINTS_PER_S = 800.0
"""Points of 25 mm at 20 m/s, which is the speed of the signals."""
OVER_POINTS = ("iri", "adaptive_end", "timer_distortion", "time_step")
"""Stages whose samples are points, whatever the rate is."""


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
    def per_point(self) -> bool:
        """Whether its samples are points."""
        return self.stage in OVER_POINTS

    def wheel_paths(self, rate: int) -> int:
        """Return for how many wheel paths a processor of ``CLOCK_HZ`` has the time, at most."""
        each_s = POINTS_PER_S if self.per_point else rate
        return int(SHARE * CLOCK_HZ / (self.estimates[rate].most * each_s))


def row(core: board.Board, stage: str, empty: tuple[int, int], traced: bool) -> Row:
    """Measure a stage; ``empty`` is what the harness takes itself."""
    image = core.image(stage)
    text, data = (a - b for a, b in zip(core.sizes(image), empty, strict=True))
    figures = {each.rate: each for each in core.run(image)}
    deepest = stack.deepest(image, core.folder)
    return Row(stage, text, data, deepest, figures, cycles.estimate(core, stage) if traced else {})


def table(rows: Sequence[Row]) -> str:
    """Return a table of text, memory, instructions and, where they were traced, cycles."""
    traced = bool(rows[0].estimates)
    head = ["stage", "text", "data", "object", "stack", "instructions"]
    head += ["cycles", "wheel paths"] if traced else []
    lines = [f"| {' | '.join(head)} |", f"|---|{'---:|' * (len(head) - 1)}"]
    for each in rows:
        rates = sorted(each.figures)
        columns = [[f"{each.figures[r].bytes}" for r in rates]]
        columns.append([f"{each.figures[r].instructions:.0f}" for r in rates])
        if traced:
            columns.append(
                [f"{each.estimates[r].fewest:.0f}–{each.estimates[r].most:.0f}" for r in rates]
            )
            columns.append([f"{each.wheel_paths(r)}" for r in rates])
        shown = [c[0] if len(set(c)) == 1 else ", ".join(c) for c in columns]
        name = f"`{each.stage}`" + (", per point" if each.per_point else "")
        cells = [name, each.text, each.data, shown[0], each.stack, *shown[1:]]
        lines.append(f"| {' | '.join(map(str, cells))} |")
    return "\n".join(lines)


def unmeasured() -> list[str]:
    """Return the objects of the header that no stage measures."""
    measured = {board.stage_kind(stage) for stage in board.stages()}
    return [f"`fr_{kind}`" for kind in board.kinds() if kind not in measured]


def main(chosen: Sequence[str]) -> int:
    """Print both tables."""
    missing = board.missing_tools()
    if missing:
        print(f"costs on a small core: skipped, {', '.join(missing)} is not installed")
        return 0
    names = list(chosen) or board.stages()
    with tempfile.TemporaryDirectory(prefix="floatref-embedded-") as folder:
        for title, target in (("Cortex-M4F, float", board.M4F), ("Cortex-M7, double", board.M7)):
            core = board.Board(target, Path(folder) / target.machine)
            empty = core.sizes(core.image("nothing"))
            rows = [row(core, stage, empty, traced=target is board.M4F) for stage in names]
            print(f"\n{title}, at 4 kHz and 16 kHz:\n\n{table(rows)}", flush=True)
    print(f"\nNot measured: {', '.join(unmeasured()) or 'nothing'}.")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
