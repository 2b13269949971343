"""Time the fit of drawn stops by the C library beside that of the SDK, in turns, in one run.

Both find pitch and 1-σ of one stretch. The library is built from its amalgamation by ``cc -O3
-ffp-contract=off``. Prints for each stop the unknowns, seconds of both and their ratio, and ns per
sample of levelling as samples come, without the fits. Run from the root of the project as ``python
-m tests.benchmarks.bench_c_level``.
"""

import subprocess
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from tests.benchmarks.timing import in_turns, ratio
from tests.sdk.c.conftest import Library
from tests.sdk.c.level_runs import RATE, Run, made_of, push, take
from tests.sdk.c.level_stops import Stop, bins_of, config_of, drive_of, fit_in_c, stretch_of

from floatref.c import amalgamation
from floatref.estimators.road_slope.gauss_newton import fit
from floatref.estimators.road_slope.levelled import _sigma
from floatref.estimators.road_slope.stretches import find_stretches

STOPS = {
    "30 km/h": Stop(speed_mps=8.3, stood_s=10.0),
    "54 km/h": Stop(),
    "80 km/h": Stop(speed_mps=22.2, brake_mps2=2.0),
    "110 km/h": Stop(speed_mps=30.6, brake_mps2=2.0),
}
ROUNDS = 5


def build(folder: Path) -> Library:
    """Return the library, built in ``folder``."""
    amalgamation.main([str(folder)])
    command = ["cc", "-std=c99", "-O3", "-ffp-contract=off", "-fPIC", "-shared"]
    command += ["-o", f"{folder}/c.so", f"{folder}/floatref.c", "-lm"]
    subprocess.run(command, check=True)
    return Library("double", folder / "c.so")


def time_stop(library: Library, name: str, stop: Stop) -> None:
    """Print a line for one stop."""
    drive, config = drive_of(stop), config_of(library, stop)
    (pieces,) = find_stretches(drive)
    bins, arrays = bins_of(library, drive, pieces)
    place = drive.distance[pieces[0].start : pieces[-1].stop]

    def by_c() -> object:
        return fit_in_c(library, config, bins)

    def by_sdk() -> object:
        return _sigma(fit(stretch_of(config, drive, pieces)), place, config.wavelength_m)

    ours, theirs = in_turns(by_c, by_sdk, rounds=ROUNDS, clock=time.process_time)
    size, passes = stretch_of(config, drive, pieces).layout.size, by_c().result.passes
    seconds = f"{np.median(ours):.3f} | {np.median(theirs):.3f} | {ratio(ours, theirs):.2f}"
    print(f"| {name} | {arrays['number'].size} | {size} | {passes} | {seconds} |")


def time_samples(library: Library) -> None:
    """Print ns per sample at a steady speed, where there is nothing to fit."""
    made, count, parts = made_of(library, Stop()), 4000, 50
    values = np.full((count, 2), 9.81), np.full((count, 2), 0.3)
    taken = 0.0
    for k in range(parts):
        run = Run(*values, (np.arange(count) + k * count) * 400)
        begin = time.process_time()
        push(made, run, slice(0, count))
        taken += time.process_time() - begin
        take(made)
    print(f"{1e9 * taken / parts / count:.0f} ns per sample of two wheel paths at {RATE:g} Hz")


def main() -> None:
    """Time all stops."""
    with tempfile.TemporaryDirectory() as folder:
        library = build(Path(folder))
        print("| stop from | bins | unknowns | passes | C, s | SDK, s | ratio |")
        for name, stop in STOPS.items():
            time_stop(library, name, replace(stop, seed=1))
        time_samples(library)


if __name__ == "__main__":
    main()
