"""Whether a certification gives the same scale of heights if run and reference are exchanged.

Run `python tests/benchmarks/bench_certify_swapped.py FOLDER`, where FOLDER holds five measured runs
of a profiler on I-76, `EB_left_1.txt`, `EB_left_2.txt` and `EB_right_1.txt` to `EB_right_3.txt`, of
`Profiles/measured/profiles` of the public repository jbbraley/I76_sub at 8bd7b0f. They have no
licence and are not part of this one. Columns are distance in ft and elevation in inches, of the
left and of the right wheel path.
"""

import os
import sys
from collections.abc import Iterator
from itertools import permutations
from pathlib import Path

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np

from floatref.measures.locating.placing import apply_placement, place
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.fitting.fit import Fit, fit
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.scales import ScaleError
from floatref_conformance.certify.plan.cutting import section_of, within

LINES = (("EB_left_1", "EB_left_2"), ("EB_right_1", "EB_right_2", "EB_right_3"))
FOOT_M, INCH_M = 0.3048, 0.0254
MARGIN_M = 1.0
TRUE_PERCENT = 3.0
LIMIT = CertificationLimits().height_percent or 0.0

Fits = dict[tuple[str, str, str], Fit]


def read(path: Path) -> Profile:
    """Return a run; its two distances are the same."""
    table = np.genfromtxt(path, delimiter="\t", skip_header=1)
    table = table[np.isfinite(table).all(axis=1)]
    interval_m = FOOT_M * float(np.median(np.diff(table[:, 0])))
    tracks = (
        ProfileTrack.of(name, INCH_M * table[:, column])
        for name, column in (("left", 1), ("right", 3))
    )
    return Profile(interval_m, tuple(tracks))


def laid(reference: Profile, run: Profile) -> tuple[Profile, Profile]:
    """Return both on the stretch that they share, the run in its place on the reference."""
    moved = apply_placement(run, place(reference, run))
    start_m = max(p.start_m for p in (reference, moved)) + MARGIN_M
    end_m = min(p.start_m + p.length_m for p in (reference, moved)) - MARGIN_M
    return section_of(reference, (start_m, end_m)), within(moved, start_m, end_m)


def fits_of(folder: Path) -> Fits:
    found = {}
    for names in LINES:
        runs = {name: read(folder / f"{name}.txt") for name in names}
        for first, second in permutations(names, 2):
            reference, run = laid(runs[first], runs[second])
            for track in ("left", "right"):
                found[first, second, track] = fit(reference, run, track)
    return found


def errors_of(fits: Fits, percent: float) -> Iterator[tuple[tuple[str, str], ScaleError]]:
    """Yield what is found of runs whose heights are ``percent`` larger than they were."""
    scale = 1.0 + percent / 100.0
    for (first, second, track), found in fits.items():
        height = 100.0 * (scale * (1.0 + found.height_percent / 100.0) - 1.0)
        yield (first, second), ScaleError(track, height, scale * found.height_sigma)


def count_named(fits: Fits, percent: float) -> tuple[int, int, int, int]:
    """Return how many wheel paths are beyond the limit, of how many, and how many runs."""
    paths, runs = 0, {}
    for pair, error in errors_of(fits, percent):
        beyond = error.beyond(LIMIT)
        paths += beyond
        runs[pair] = runs.get(pair, False) or beyond
    return paths, len(fits), sum(runs.values()), len(runs)


def main(folder: Path) -> None:
    fits = fits_of(folder)
    symmetric = []
    print("reference, run, wheel path: ln g in %, exchanged, 1-sigma, long waves in %")
    for (first, second, track), found in fits.items():
        if first > second:
            continue
        back = fits[second, first, track]
        gains = [100.0 * np.log1p(one.height_percent / 100.0) for one in (found, back)]
        symmetric.append(np.mean(gains))
        long = found.long_waves.error_percent if found.long_waves else np.nan
        print(
            f"{first} {second} {track}: {gains[0]:+.2f} {gains[1]:+.2f} "
            f"± {found.height_sigma:.2f}, {long:.1f}"
        )
    mean, largest = np.mean(symmetric), np.max(np.abs(symmetric))
    print(f"symmetric part: mean {mean:+.3f} %, largest {largest:.3f} %")
    print(f"healthy: {count_named(fits, 0.0)[0]} of {len(fits)} wheel paths fail")
    for percent in (TRUE_PERCENT, -TRUE_PERCENT):
        paths, of, runs, pairs = count_named(fits, percent)
        print(f"heights {percent:+g} %: {runs} of {pairs} runs named, {paths} of {of} wheel paths")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
