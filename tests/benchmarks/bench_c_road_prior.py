"""What a fixed lag costs the road prior: libfloatref beside the SDK's smoother of the whole run.

Two simulated drives of one wheel path at 1 kHz, without pitch levelling on either side: 4 km at a
constant speed, and 2.6 km with four stops of 20 s. For each lag it prints the memory, the time per
sample, the share of points that are flagged as unsettled, and by how much the elevation behind the
high-pass of 91.44 m differs from that of the whole run, over all points and over those that are not
flagged. Run as ``python tests/benchmarks/bench_c_road_prior.py``.
"""

import tempfile
import time
from fractions import Fraction
from pathlib import Path

import numpy as np
from bench_c_library import Library

from floatref.estimators.road_prior import RoadPriorSmoother
from floatref.measures import high_pass
from floatref.values.arrays import FloatArray
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

RATE_HZ, COUNT_M, INTERVAL_M, WAVELENGTH_M = 1000.0, 1e-4, 0.05, 91.44
UNSETTLED, GRAVITY = 8, 9.80665
ALIKE = {"imu": False, "gnss": False, "response": False, "laser_ahead_m": 0.0, "rate_hz": RATE_HZ}
DRIVES = {
    "constant": Scenario(seed=3, length_m=4000.0, tracks=("left",), **ALIKE),
    "four stops": Scenario(
        seed=3,
        tracks=("left",),
        manoeuvre="stop",
        speed_kmh=60.0,
        dwell_s=20.0,
        stops=4,
        stop_spacing_m=400.0,
        event_at_m=600.0,
        length_m=2600.0,
        slip_percent_per_g=0.3,
        **ALIKE,
    ),
}
LAGS = (60.0, 500.0), (60.0, 100.0), (30.0, 500.0), (20.0, 500.0), (20.0, 100.0), (10.0, 500.0)
"""In s, with nodes per second."""
Signals = tuple[FloatArray, FloatArray, np.ndarray]


def signals(scenario: Scenario) -> Signals:
    """Return acceleration without 1 g, height and counts."""
    recording = simulate(scenario).recording
    force, height = (
        recording.channel(name, "left") for name in ("vertical_specific_force", "height")
    )
    distance = recording.channel("distance")
    h, d = (np.interp(force.times_s, c.times_s, c.values) for c in (height, distance))
    return force.values - GRAVITY, h, np.rint(d / COUNT_M).astype(np.int64)


def whole_run(given: Signals) -> FloatArray:
    """Return the elevation of the points, smoothed by the whole run."""
    a, h, counts = given
    distance = (counts - counts[0]) * COUNT_M
    names = "vertical_acceleration", "height"
    values = {ChannelId(n, "left"): x for n, x in zip(names, (a, h), strict=True)}
    values[ChannelId("distance")] = distance
    stage = RoadPriorSmoother(tolerance_m=0.0, waiting_s=1e9, longest_s=1e9)
    rate = Fraction(int(RATE_HZ))
    stage.start(Header(Axis.TIME, 1 / RATE_HZ, 0.0, rate, frozenset(values), ("left",)))
    made = join_blocks([b for b in (stage.push(Block(0, values)), *stage.finish()) if len(b)])
    places = np.arange(int(distance[-1] / INTERVAL_M + 1e-6) + 1) * INTERVAL_M
    at = np.searchsorted(distance, places - 1e-6 * INTERVAL_M)
    elevation: FloatArray = (made[ChannelId("floating_reference_height", "left")] - h)[at]
    return elevation


def run(library: Library, given: Signals, lag_s: float, nodes_hz: float) -> tuple[str, FloatArray]:
    """Return the memory in MB and ns per sample, and elevation and flags of the points."""
    ffi, lib = library.ffi, library.lib
    config = ffi.new("fr_road_prior_config *", lib.fr_road_prior_defaults())
    config.rate_hz, config.metres_per_count, config.interval_m = RATE_HZ, COUNT_M, INTERVAL_M
    config.lag_s, config.node_rate_hz = lag_s, nodes_hz
    size, out = lib.fr_road_prior_size(config), ffi.new("fr_road_prior **")
    memory, room, written = np.zeros(size // 8 + 1), 200_000, ffi.new("size_t *")
    assert lib.fr_road_prior_init(ffi.from_buffer(memory), memory.nbytes, config, out) == 0
    points, flags, made = np.empty((2, room)), np.empty(room, np.uint8), []
    outputs = *(ffi.cast("double *", x.ctypes.data) for x in points), ffi.from_buffer(flags)
    inputs = [ffi.cast(f"{t} *", x.ctypes.data) for t, x in zip(TYPES, given, strict=True)]
    begun = time.perf_counter()
    assert lib.fr_road_prior_push(out[0], *inputs, given[0].size, *outputs, room, written) == 0
    made.append(np.stack((points[0], flags))[:, : written[0]])
    assert lib.fr_road_prior_finish(out[0], *outputs, room, written) == 0
    taken_ns = 1e9 * (time.perf_counter() - begun) / given[0].size
    made.append(np.stack((points[0], flags))[:, : written[0]])
    return f"{size / 1e6:.1f} | {taken_ns:.0f}", np.concatenate(made, axis=1)


TYPES = "double", "double", "int64_t"


def main() -> None:
    """Print a table."""
    with tempfile.TemporaryDirectory(prefix="bench-road-") as folder:
        library = Library(Path(folder), ["-O2", "-ffp-contract=off"])
        print(
            "| drive | lag, s | nodes/s | MB | ns per sample | flagged, % | all, mm | others, mm |"
        )
        print("|---|---:|---:|---:|---:|---:|---:|---:|")
        for name, scenario in DRIVES.items():
            given = signals(scenario)
            expected = whole_run(given)
            for lag_s, nodes_hz in LAGS:
                costs, (elevation, flags) = run(library, given, lag_s, nodes_hz)
                off = elevation - expected
                off_mm = 1e3 * np.abs(high_pass(off - off[0], INTERVAL_M, WAVELENGTH_M))
                settled = (flags.astype(int) & UNSETTLED) == 0
                line = f"| {name} | {lag_s:.0f} | {nodes_hz:.0f} | {costs} "
                line += f"| {100 * (1 - settled.mean()):.0f} | {off_mm.max():.2f} "
                print(line + f"| {off_mm[settled].max():.2f} |")


if __name__ == "__main__":
    main()
