"""A laser that drops out: the error in the gap and beside it, with the vehicle's response and not.

python tests/benchmarks/bench_fall_back.py [--draws N] [--page FILE]
"""

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
from bench_response import drive
from road_prior_measuring import quietly, truth
from tables import show, write_page

import floatref
from floatref.measures import high_pass
from floatref_conformance.proving_ground.simulate import Simulation

PIPELINES = ("temporal-basic", "temporal-adaptive-hpf-spatial-backward", "road-prior-smoother")
GAPS_M = (2.0, 10.0, 30.0)
BEGIN_M, BESIDE_M = 230.0, 30.0
SPEED_KMH = 72.0
NOMINAL = ("vertical_specific_force", "height", "distance")
COLUMNS = ("gap", "pipeline", "line: in it, mm", "beside, mm", "response: in it, mm", "beside, mm ")


def dropped(recording: floatref.Recording, length_m: float, response: bool) -> floatref.Recording:
    """Return the recording without heights over ``length_m``, with its ``response`` or not."""
    distance = recording.channel("distance").values
    gone = (distance > BEGIN_M) & (distance < BEGIN_M + length_m)
    channels = [
        replace(c, values=np.where(gone, np.nan, c.values)) if c.id.name == "height" else c
        for c in recording.channels
        if response or c.id.name in NOMINAL
    ]
    return replace(recording, channels=tuple(channels))


def errors(made: Simulation, profile: floatref.Profile, length_m: float) -> tuple[float, float]:
    """Return the RMS error in the gap and beside it, in mm, over all wheel paths."""
    places = profile.distance_m
    inside = (places >= BEGIN_M) & (places < BEGIN_M + length_m)
    beside = ((places >= BEGIN_M - BESIDE_M) & (places < BEGIN_M + length_m + BESIDE_M)) & ~inside
    squares: list[list[float]] = [[], []]
    for track in profile.tracks:
        road = high_pass(truth(made, track.name, places), profile.interval_m)
        for found, where in zip(squares, (inside, beside), strict=True):
            found.append(float(np.mean((track.elevation - road)[where] ** 2)))
    inner, outer = (1e3 * float(np.sqrt(np.mean(each))) for each in squares)
    return inner, outer


def lines(draws: int) -> list[list[str]]:
    """Return a line for every gap and pipeline."""
    found = []
    for length_m in GAPS_M:
        for pipeline in PIPELINES:
            row = []
            for response in (False, True):
                each = []
                for draw in range(draws):
                    made = drive(SPEED_KMH, draw)
                    recording = dropped(made.recording, length_m, response)
                    each.append(errors(made, quietly(recording, pipeline, {}), length_m))
                row += [f"{x:.2f}" for x in np.sqrt(np.mean(np.square(each), axis=0))]
            found.append([f"{length_m:g} m", pipeline, *row])
    return found


def main() -> None:
    """Print the table, and write it into a page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--draws", type=int, default=4)
    parser.add_argument("--page", type=Path, help="Markdown page whose table is replaced")
    asked = parser.parse_args()
    table = lines(asked.draws)
    show("RMS error at 72 km/h", COLUMNS, table, 120)
    if asked.page:
        write_page(asked.page, table, COLUMNS)


if __name__ == "__main__":
    main()
