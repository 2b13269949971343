"""Draw each flaw on the probe that shows it most: the delivered profile over the true one, as SVG.

    python .ci/flaw_pictures.py

It runs every mutant on one probe and writes docs/images/flaws/MUTANT.svg.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from floatref.measures import high_pass
from floatref.values.arrays import BoolArray, FloatArray
from floatref_conformance.devices.interface import RESPONSE
from floatref_conformance.judge.exercise import describe
from floatref_conformance.mutants.device import make
from floatref_conformance.resemblance.catalogue import FlawVector, find_range, read_vectors
from floatref_conformance.resemblance.probe_answers import Answer, ask_probes
from floatref_conformance.resemblance.probes import PROBES

FOLDER = Path(__file__).parents[1] / "docs" / "images" / "flaws"
WIDTH, HEIGHT, MARGIN, BOTTOM = 480, 150, 8, 34
MOST_POINTS = 220
WINDOWS_M = (6.0, 20.0, 60.0)
"""Lengths of road of which the one is drawn in which the error is largest beside the profile."""
EDGE = 0.2
"""Share of a run at each end in which nothing is sought: a high-pass settles there."""
NO_PROFILE = ("nothing", "length", "begin", "missing", "missing at the end")


@dataclass(frozen=True, eq=False)
class Drawn:
    """What a picture shows: places in m, true and delivered elevations in m, and flags."""

    probe: str
    distance_m: FloatArray
    truth: FloatArray
    found: FloatArray
    valid: BoolArray


def find_probe(flaw: FlawVector) -> str:
    """Return the probe on which a flaw exceeds good devices most, among those with a profile."""
    good = find_range(read_vectors(), RESPONSE not in flaw.needs)
    beyond: dict[str, float] = {}
    for name, value in good.exceed(flaw.features).items():
        probe, _, what = name.partition(": ")
        if flaw.features.get(f"{probe}: nothing") == 0.0 and what not in NO_PROFILE:
            beyond[probe] = beyond.get(probe, 0.0) + value**2
    return max(beyond, key=lambda probe: beyond[probe], default="road")


def shows_flags(flaw: FlawVector, probe: str) -> bool:
    """Return whether the feature that is largest on ``probe`` is that of a flag."""
    good = find_range(read_vectors(), RESPONSE not in flaw.needs)
    beyond = good.exceed(flaw.features)
    there = [name for name in beyond if name.startswith(f"{probe}: ")]
    return "flagged" in max(there, key=lambda name: abs(beyond[name]), default="")


def draw_mutant(flaw: FlawVector) -> Drawn:
    """Return what the mutant of ``flaw`` makes of its probe, cut to where it shows."""
    device = make(flaw.mutant)
    name = find_probe(flaw)
    # Those that deliver an earlier profile need one before it.
    wanted = [probe for probe in PROBES if probe.name in ("crawl", "medium", name)]
    answers = list(ask_probes(device, describe(device), wanted))
    answer = next(a for a in answers if a.probe.name == name)
    return cut(read_lines(answer), shows_flags(flaw, name))


def read_lines(answer: Answer) -> Drawn:
    """Return truth and profile of the first wheel path on the truth's points, both filtered."""
    truth, profile = answer.taken.truth, answer.profile
    if profile is None:
        raise ValueError(f"{answer.probe.name}: {answer.fault}")
    name = truth.tracks[0].name
    x = truth.distance_m
    true = high_pass(truth.track(name).elevation, truth.interval_m)
    track = profile.track(name)
    found = np.interp(x, profile.distance_m, track.elevation, left=np.nan, right=np.nan)
    valid = np.interp(x, profile.distance_m, track.valid.astype(float)) > 0.5
    return Drawn(answer.probe.name, x, true, found, valid)


def cut(drawn: Drawn, whole: bool) -> Drawn:
    """Return the stretch in which the error varies most beside what is drawn, all if ``whole``.

    The profile is moved to the truth's mean there: what is level is no error of a profile.
    """
    error = drawn.found - drawn.truth
    if whole or np.isnan(error).mean() > 0.05:
        return drawn
    step = float(drawn.distance_m[1] - drawn.distance_m[0])
    best, chosen = -1.0, slice(None)
    for length_m in WINDOWS_M:
        count, edge = round(length_m / step), round(EDGE * error.size)
        for part in _windows(error.size, count, edge):
            level = drawn.found[part] - np.nanmean(error[part])
            span = float(np.nanmax(level) - np.nanmin(level)) + np.ptp(drawn.truth[part])
            shown = float(np.nanstd(error[part])) / max(float(span), 2e-5)
            if shown > 1.1 * best:
                best, chosen = shown, part
    stretch = _part(drawn, chosen)
    return replace(stretch, found=stretch.found - np.nanmean(error[chosen]))


def _windows(size: int, count: int, edge: int) -> Iterator[slice]:
    for first in range(edge, max(size - edge - count, edge) + 1, max(count // 2, 1)):
        yield slice(first, min(first + count, size))


def _part(d: Drawn, part: slice) -> Drawn:
    return replace(
        d,
        distance_m=d.distance_m[part],
        truth=d.truth[part],
        found=d.found[part],
        valid=d.valid[part],
    )


def write_svg(drawn: Drawn, title: str) -> str:
    """Return the picture: the truth wide and grey, the profile narrow, what is flagged below."""
    every = max(drawn.distance_m.size // MOST_POINTS, 1)
    d = _part(drawn, slice(None, None, every))
    both = np.concatenate((d.truth, d.found[np.isfinite(d.found)]))
    low, high = float(both.min()), float(both.max())
    if high - low < 2e-4:
        low, high = (low + high) / 2 - 1e-4, (low + high) / 2 + 1e-4
    x0, x1 = float(d.distance_m[0]), float(d.distance_m[-1])

    def across(x: FloatArray) -> FloatArray:
        return MARGIN + (x - x0) / (x1 - x0) * (WIDTH - 2 * MARGIN)

    def down(z: FloatArray) -> FloatArray:
        return MARGIN + (high - z) / (high - low) * (HEIGHT - MARGIN - BOTTOM)

    span = f"{x0:.6g} {x1:.6g} {low:.9g} {high:.9g}"
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
        f'width="{WIDTH}" height="{HEIGHT}" data-probe="{d.probe}" data-span="{span}">',
        f"<title>{title}</title>",
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
        _polyline("truth", across(d.distance_m), down(d.truth), "#b8bec6", 4.0),
    ]
    for part in _pieces(np.isfinite(d.found)):
        xs, ys = across(d.distance_m[part]), down(d.found[part])
        lines.append(_polyline("profile", xs, ys, "#b3261e", 1.3))
    for part in _pieces(~d.valid):
        first, last = across(d.distance_m[part])[[0, -1]]
        lines.append(
            f'<rect class="flagged" x="{first:.1f}" y="{HEIGHT - BOTTOM + 4}" '
            f'width="{max(last - first, 1):.1f}" height="5" fill="#e0a100"/>'
        )
    lines += [_text(MARGIN, "start", f"{x0:.4g} m"), _text(WIDTH - MARGIN, "end", f"{x1:.4g} m")]
    lines.append(
        _text(WIDTH / 2, "middle", f"{d.probe}; height of the picture {_length(high - low)}")
    )
    return "\n".join([*lines, "</svg>\n"])


def _pieces(where: BoolArray) -> Iterator[slice]:
    edges = np.flatnonzero(np.diff(np.concatenate(([0], where.astype(np.int8), [0]))))
    for first, last in zip(edges[::2], edges[1::2], strict=True):
        yield slice(int(first), int(last))


def _polyline(kind: str, x: FloatArray, y: FloatArray, colour: str, width: float) -> str:
    points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))
    return (
        f'<polyline class="{kind}" points="{points}" fill="none" stroke="{colour}" '
        f'stroke-width="{width}" stroke-linejoin="round"/>'
    )


def _text(x: float, anchor: str, text: str) -> str:
    return (
        f'<text x="{x:g}" y="{HEIGHT - 8}" text-anchor="{anchor}" font-family="sans-serif" '
        f'font-size="12" fill="#333">{text}</text>'
    )


def _length(metres: float) -> str:
    for factor, unit in ((1.0, "m"), (1e3, "mm"), (1e6, "µm")):
        if metres * factor >= 1.0:
            return f"{metres * factor:.3g} {unit}"
    return f"{metres * 1e6:.2g} µm"


def main() -> None:
    """Draw all flaws that have a profile."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for flaw in read_vectors().flaws:
        svg = write_svg(draw_mutant(flaw), f"The profile of mutant:{flaw.mutant} over the truth")
        (FOLDER / f"{flaw.mutant}.svg").write_text(svg, encoding="utf-8")


if __name__ == "__main__":
    main()
