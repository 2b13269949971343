"""Write the golden vectors of the conformance suite, or compare them.

    python .ci/golden.py [--check]

The expected outputs are the reference's, in extended precision but for the Kalman smoother's. The
tolerance of single precision is four times the error measured with `golden_single`, rounded up to
one digit.
"""

import argparse
import json
import math
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import golden_kalman as kalman
import golden_road_prior as road_prior
import golden_single as single
import numpy as np
from golden_vectors import Vector, vectors

from floatref_reference.chapter_5.section_5_3 import trigger

FOLDER = Path(__file__).parents[1] / "conformance" / "floatref_conformance" / "golden"
DOUBLE = 1e-9
"""Relative to the largest magnitude of an output; a good form is a thousand times better."""
MARGIN, LEAST = 4.0, 1e-6
F = np.float32
Given = Mapping[str, Any]


def pipeline_in_time(s: Given, i: Given) -> dict[str, Any]:
    """Section 5.7 with the backward pass over distance, at a rate without anti-alias filter."""
    dt, dx = 1 / s["rate_hz"], s["interval_m"]
    a, h = i["acceleration"].astype(F), i["height"].astype(F)
    points, speed = trigger(i["distance"], dx), single.travel_speed(i["distance"], s["rate_hz"])
    c = single.tangents(single.frequency(speed), dt, a.size)
    r = single.integral(single.high_2(single.integral(single.high_1(a, c), dt), c), dt)
    z = single.captured(r - single.high_2(single.high_1(h - h[0], c), c), points)
    wave_number = single.wave_number(single.captured(speed.astype(F), points), dx)
    c = single.tangents(wave_number, dx, z.size)[::-1]
    return {"elevation": single.high_1(single.high_2(z[::-1], c), c)[::-1]}


def pipeline_over_distance(s: Given, i: Given) -> dict[str, Any]:
    """Section 5.10 at a rate without anti-alias filter."""
    dx = s["interval_m"]
    points = trigger(i["distance"], dx)
    a, h = (single.captured(i[name].astype(F), points) for name in ("acceleration", "height"))
    time = np.array([float(k - 1 + part) / s["rate_hz"] for k, part in points])
    dt = np.diff(time, prepend=time[0]).astype(F)
    adjusted, c = single.adjusted(dt, dx), single.tangents(1 / 105.91, dx, a.size)
    v = single.high_2(single.integral(single.high_1(a, c), adjusted), c)
    height = single.high_2(single.high_1(h - h[0], c), c)
    z = single.reflected(v, adjusted, dt, height) - height
    return {"elevation": single.high_1(single.high_2(z[::-1], c), c)[::-1]}


def high_pass(s: Given, i: Given) -> dict[str, Any]:
    """HPF_B3x2 of a profile that counts from its first point."""
    z = i["elevation"].astype(F)
    c = single.tangents(single.SIXTH / s["wavelength_m"], s["interval_m"], z.size)
    z = single.high_2(single.high_1(z - z[0], c)[::-1], c)
    return {"filtered": single.high_2(single.high_1(z, c)[::-1], c)}


def roughness(s: Given, i: Given) -> dict[str, Any]:
    """Trace and IRI."""
    found = single.trace(i["elevation"].astype(F), s["interval_m"])
    return {"trace": found, "iri": [np.mean(np.abs(found))]}


def in_single(vector: Vector) -> Mapping[str, Any]:
    """Return the outputs of ``vector`` in single precision; empty if there is no rounding."""
    s, i = vector.settings, vector.inputs
    f = {name: np.asarray(x).astype(F) for name, x in i.items()}
    stages = {
        "trapezoidal-rule": lambda: {"y": single.integral(f["x"], s["step"], s["start"])},
        "travel-speed": lambda: {"speed": single.travel_speed(i["distance"], s["rate_hz"])},
        "adaptive-cut-off": lambda: {
            "frequency": single.frequency(i["speed"]),
            "wave_number": single.wave_number(i["speed"], s["interval_m"]),
        },
        "local-suppression": lambda: {"y": single.controlled(f["x"], f["speed"], s)},
        "projection": lambda: {
            "y": single.captured(f["x"], trigger(i["distance"], s["interval_m"]))
        },
        "time-step": lambda: {"time_step": np.diff(i["time"], prepend=i["time"][0]).astype(F)},
        "timer-distortion": lambda: {"adjusted": single.adjusted(f["time_step"], s["interval_m"])},
        "spatial-integration": lambda: {"y": single.integral(f["x"], f["time_step"])},
        "reflection": lambda: {"reference_height": single.reflected(*f.values())},
        "adaptive-hpf-spatial-backward": lambda: pipeline_in_time(s, i),
        "timer-distortion-reflection": lambda: pipeline_over_distance(s, i),
        "matched-high-pass": lambda: {
            "elevation": single.observed(
                f["acceleration"],
                f["height"],
                single.tangents(i["cutoff"], 1 / s["rate_hz"], f["height"].size),
                1 / s["rate_hz"],
            )
        },
        "kalman-smoother": lambda: {
            "elevation": kalman.elevation(s, kalman.rounded_to_single(i)).astype(F)
        },
        # Its states are double: in single precision a variance comes out below zero.
        "road-prior-smoother": lambda: {
            "elevation": road_prior.elevation(s, {**f, "distance": i["distance"]}, float).astype(F)
        },
        "iri": lambda: roughness(s, i),
        "cross-correlation": lambda: {
            name: [value]
            for name, value in zip(
                vector.outputs, single.agreement(f["p"], f["q"], s["interval_m"]), strict=True
            )
        },
        "high-pass": lambda: high_pass(s, i),
        "validity": dict,
    }
    return stages[vector.stage]() if vector.stage in stages else section(vector)


def section(vector: Vector) -> Mapping[str, Any]:
    """Return the output of a stage of Table A.1."""
    kernels = {
        "lpf-b3s1": single.low_1,
        "lpf-b3s2": single.low_2,
        "hpf-b3s1": single.state_1 if "state" in vector.stage else single.high_1,
        "hpf-b3s2": single.state_2 if "state" in vector.stage else single.high_2,
    }
    backward = vector.stage[8:9] == "r"
    result: Mapping[str, Any] = single.section(kernels[vector.stage[:8]], backward)(
        vector.settings, vector.inputs
    )
    return result


def single_tolerance(vector: Vector) -> float:
    """Return four times the largest error in single precision, rounded up to one digit."""
    worst = LEAST
    for name, found in in_single(vector).items():
        expected = np.asarray(vector.outputs[name], float)
        error = np.abs(np.asarray(found, float) - expected).max() / np.abs(expected).max()
        worst = max(worst, MARGIN * float(error))
    unit = 10.0 ** math.floor(math.log10(worst))
    return float(f"{math.ceil(worst / unit - 1e-9) * unit:.0e}")


def documents() -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield name and JSON document of every vector."""
    for vector in vectors():
        yield (
            vector.name,
            {
                "format": "floatref-golden/1",
                "stage": vector.stage,
                "equation": vector.equation,
                "settings": dict(vector.settings),
                "inputs": {name: np.asarray(x).tolist() for name, x in vector.inputs.items()},
                "outputs": {
                    name: np.asarray(y, dtype=float).tolist() for name, y in vector.outputs.items()
                },
                "tolerance": {"float64": DOUBLE, "float32": single_tolerance(vector)},
            },
        )


def main() -> int:
    """Write the vectors or compare them; return 1 if one is another."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare, do not write")
    check = parser.parse_args().check
    different = []
    for name, document in documents():
        file, text = FOLDER / f"{name}.json", json.dumps(document) + "\n"
        if not check:
            file.write_text(text, encoding="ascii")
        elif not file.exists() or file.read_text(encoding="ascii") != text:
            different.append(file.name)
    if different:
        print(f"{', '.join(different)}: out of date: python .ci/golden.py", file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
