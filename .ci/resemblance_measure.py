"""Write docs/data/resemblance.json: how often a flaw is recognized that is not the catalogue's own.

    python .ci/resemblance_measure.py

Every mutation is put into another pipeline than its own, and where it has a size, with half and
with twice that size. It takes minutes. Mutations that are a whole pipeline are not measured.
"""

import json
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from floatref_conformance.devices.interface import Description, Device
from floatref_conformance.judge.exercise import describe
from floatref_conformance.mutants import MUTATIONS
from floatref_conformance.mutants import profiles as p
from floatref_conformance.mutants import recordings as r
from floatref_conformance.mutants.device import Mutant
from floatref_conformance.mutants.drive_conditions import apply_when, middle_m
from floatref_conformance.mutants.engine import in_time
from floatref_conformance.mutants.in_drives import (
    _brakes,
    _crawls,
    _is_slow,
    _nearly_stops,
    _rolls_out,
    _sets_off,
    _speeds_up,
    _stops,
    _stops_from_high_speed,
)
from floatref_conformance.mutants.in_processing import _use_engine
from floatref_conformance.mutants.mutation import AUGMENTED, RECOMMENDED, SPATIAL, Mutation
from floatref_conformance.resemblance.catalogue import rank_flaws, read_vectors
from floatref_conformance.resemblance.comparing import LEAST, MOST_FLAWS
from floatref_conformance.resemblance.features import Features, measure_features
from floatref_conformance.resemblance.probe_answers import ask_probes

DATA = Path(__file__).parents[1] / "docs" / "data" / "resemblance.json"
FORMAT = "conformance-resemblance/1"
OTHER = {RECOMMENDED: SPATIAL, AUGMENTED: "kalman-smoother"}
"""The pipeline into which a mutation is put in place of its own."""
UNMOVED = ("tilt-ignored", "slip-believed", "gravity-kept", "height-in-mm", "carry-leaking")
UNMOVED += ("reverse-pass-missing",)
"""Mutations that are a pipeline without any further error, or that bring their own elevations."""
FACTORS = (0.5, 2.0)


def _before(change: Any) -> dict[str, Any]:
    return {"before": change}


def _of_force(change: Any) -> dict[str, Any]:
    return _before(r.change_channel(r.FORCE, change))


def _of_height(change: Any) -> dict[str, Any]:
    return _before(r.change_channel(r.HEIGHT, change))


def _after(change: Any) -> dict[str, Any]:
    return {"after": change}


SIZED = {
    "accelerometer-high": lambda f: _of_force(r.scale_acceleration(1 + 0.01 * f)),
    "accelerometer-low": lambda f: _of_force(r.scale_acceleration(1 - 0.01 * f)),
    "laser-high": lambda f: _of_height(r.scale(1 + 0.01 * f)),
    "laser-low": lambda f: _of_height(r.scale(1 - 0.01 * f)),
    "late-laser": lambda f: _of_height(r.delay_by(0.002 * f)),
    "late-accelerometer": lambda f: _of_force(r.delay_by(0.002 * f)),
    "sample-lost": lambda f: _of_force(r.lose_samples(round(4096 / f))),
    "cut-off-long": lambda f: {"settings": {"cutoff_wavelength_m": (1 + 0.1 * f) * 105.91}},
    "cut-off-short": lambda f: {"settings": {"cutoff_wavelength_m": (1 - 0.1 * f) * 105.91}},
    "carry-leaking": lambda f: _after(_use_engine(in_time(carry=1 - 0.1 * f))),
    "scaled": lambda f: _after(p.scale(1 - 0.2 * f)),
    "over-smoothed": lambda f: _after(p.average(2.0 * f)),
    "staircase": lambda f: _after(p.hold_in_steps(0.5 * f)),
    "coarse": lambda f: _after(p.round_to(0.001 * f)),
    "noisy-where-flat": lambda f: _after(p.add_noise_where_flat(0.00008 * f)),
    "motion-where-flat": lambda f: _after(p.add_motion_where_flat(0.01 * f)),
    "displaced": lambda f: _after(p.move(0.3 * f)),
    "stretched": lambda f: _after(p.stretch(0.003 * f)),
    "nan-at-the-end": lambda f: _after(p.drop_end(120.0 * f)),
    "begins-late": lambda f: _after(p.drop_start(5.0 * f)),
    "middle-flagged": lambda f: _after(p.flag_around(middle_m, 124.0 * f)),
    "held-at-the-stop": lambda f: _after(p.hold_at_slowest(20.0 * f)),
    "slow-drive-low": lambda f: _after(apply_when(_is_slow, p.scale(1 - 0.1 * f))),
    "crawl-low": lambda f: _after(apply_when(_crawls, p.chain(p.scale(1 - 0.1 * f), p.mark_valid))),
    "coasting-flagged": lambda f: _after(
        apply_when(_rolls_out, p.flag_around(middle_m, 200.0 * f))
    ),
    "throttle-flagged": lambda f: _after(
        apply_when(_speeds_up, p.flag_around(middle_m, 200.0 * f))
    ),
    "straight-at-the-release": lambda f: _after(
        apply_when(_brakes, p.straighten_at_slowest(30.0 * f))
    ),
    "straight-at-a-near-stop": lambda f: _after(
        apply_when(_nearly_stops, p.straighten_at_slowest(30.0 * f))
    ),
    "straight-at-a-stop-from-speed": lambda f: _after(
        apply_when(_stops_from_high_speed, p.straighten_at_slowest(30.0 * f))
    ),
    "straight-at-the-start": lambda f: _after(
        apply_when(_sets_off, p.straighten_at_slowest(60.0 * f))
    ),
    "road-lost-at-a-stop": lambda f: _after(apply_when(_stops, p.lose_at_slowest(0.3 * f))),
}
"""What a mutation becomes with a size that is a multiple of its own."""


def list_variants() -> Iterator[tuple[str, str, Mutation]]:
    """Yield name, kind of variant and the mutation that is measured."""
    for mutation in MUTATIONS:
        if mutation.pipeline in OTHER and mutation.name not in UNMOVED:
            moved = replace(mutation, pipeline=OTHER[mutation.pipeline])
            yield mutation.name, "another pipeline", moved
        for factor in FACTORS if mutation.name in SIZED else ():
            kind = "half the size" if factor < 1 else "twice the size"
            yield mutation.name, kind, replace(mutation, **SIZED[mutation.name](factor))


def measure(device: Device) -> tuple[Description, Features]:
    """Return what ``device`` says of itself, and its features on the probes."""
    description = describe(device)
    return description, measure_features(ask_probes(device, description))


def rank(description: Description, features: Features) -> list[tuple[str, float]]:
    """Return the first flaws that a device resembles, with what they have in common."""
    ranked = rank_flaws(features, description, read_vectors())
    return [(one.mutant, one.alike) for one in ranked[:MOST_FLAWS] if one.alike >= LEAST]


Measured = list[tuple[str, str, Description, Features]]
"""Name of the flaw, kind of variant, and what was measured of it."""


def measure_variants() -> Measured:
    """Return the features of all variants."""
    begin_s, measured = time.monotonic(), []
    for name, kind, mutation in list_variants():
        print(f"{time.monotonic() - begin_s:6.1f} s  {name}, {kind}", file=sys.stderr, flush=True)
        measured.append((name, kind, *measure(Mutant(mutation))))
    return measured


def write(measured: Measured) -> None:
    """Write which flaws all variants resemble by the vectors of the catalogue."""
    rows = []
    for name, kind, description, features in measured:
        found = rank(description, features)
        named = [mutant for mutant, _ in found]
        place = named.index(name) + 1 if name in named else 0
        rows.append({"flaw": name, "variant": kind, "place": place, "named": found})
    text = ",\n".join(f"  {json.dumps(row)}" for row in rows)
    DATA.write_text(f'{{"format": "{FORMAT}", "rows": [\n{text}\n]}}\n', encoding="utf-8")


if __name__ == "__main__":
    write(measure_variants())
