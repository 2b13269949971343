"""What the skew of laser and accelerometer is found to be where it is known.

Run `python tests/benchmarks/bench_sensor_skew.py` for the tables of the page on clocks.
"""

import os
from collections.abc import Callable, Iterator
from dataclasses import replace

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np
from kind_drives import KIND

from floatref.measures.clocks.sensor_skew import (
    STANDS_M,
    STANDS_S,
    WINDOW_S,
    sensor_skew,
    skew_warning,
)
from floatref.measures.clocks.skew_series import RATE_HZ, STEP_S, find_standing, on_grid, stretches
from floatref.measures.clocks.skew_windows import skew_window
from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground import Scenario, simulate
from floatref_conformance.proving_ground.cache import simulate_cached
from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES

COUNT = round(WINDOW_S * RATE_HZ)
"""Points of the window in which the estimators are compared, or as many as the stop lasts."""
HOLD_S = 0.5 / 3240.0
SHIFTS_MS = (-3.0, -1.0, 0.0, 0.3, 1.0, 3.0)
DRAWN = 40


def parts(recording: Recording) -> tuple[Channel, Channel, Channel]:
    """Return force, height and distance of the left wheel path."""
    names = ("vertical_specific_force", "height", "distance")
    force, height, distance = (recording.channel(name, "left") for name in names)
    return force, height, distance


def later(channel: Channel, by_s: float) -> Channel:
    assert isinstance(channel.clock, UniformClock)
    return replace(channel, clock=UniformClock(channel.clock.rate, by_s))


def run_row(name: str) -> str:
    """Return the row of a run: what is found, and the largest error of six shifts."""
    only = {"tracks": ("left",), "imu": False, "gnss": False, **KIND}
    force, height, distance = parts(simulate_cached(Scenario(manoeuvre=name, **only)).recording)
    found = sensor_skew(force, height, distance)
    errors, warned = [], []
    for shift_ms in SHIFTS_MS:
        shifted = later(height, shift_ms / 1e3)
        skew = sensor_skew(force, shifted, distance)
        if skew.known:
            errors.append(abs(skew.skew_s - HOLD_S - shift_ms / 1e3))
        if skew_warning(skew, force, shifted):
            warned.append(f"{shift_ms:+g}")
    if not found.known:
        figure = f"open, {1e3 * found.sigma_s:.2f}" if found.sigma_s > 0 else "open, no such moment"
        return f"| {name} | {figure} | | {', '.join(warned) or '–'} |"
    figure = f"{1e3 * found.skew_s:+.3f} ± {1e3 * found.sigma_s:.3f}"
    return f"| {name} | {figure} | {1e3 * max(errors):.3f} | {', '.join(warned) or '–'} |"


def drawn_stops() -> Iterator[tuple[str, Recording]]:
    """Yield vehicle and recording of stops over drawn roads."""
    for seed in range(DRAWN):
        rng = np.random.default_rng(seed)
        vehicle = list(VEHICLES)[seed % len(VEHICLES)]
        scenario = Scenario(
            seed=seed,
            manoeuvre="stop",
            vehicle=vehicle,
            iri_m_per_km=float(rng.choice([1.0, 1.8, 3.0, 5.0])),
            speed_kmh=50.0,
            final_speed_kmh=40.0,
            deceleration_g=float(rng.choice([0.1, 0.2, 0.35])),
            dwell_s=float(rng.choice([1.1, 2.0, 4.0, 8.0])),
            event_at_m=150.0,
            length_m=250.0,
            rate_hz=5000.0,
            tracks=("left",),
            imu=False,
            gnss=False,
            **KIND,
        )
        yield vehicle, simulate(scenario).recording


def stopping(recording: Recording) -> tuple[FloatArray, FloatArray, int, int]:
    """Return force and height on the grid, and where the stop begins."""
    force, height, distance = parts(recording)
    begin, end = force.span_s
    grid = begin + STEP_S * np.arange(int((end - begin) * RATE_HZ))
    (first, end), *_ = stretches(find_standing(distance, grid, STANDS_M, STANDS_S))
    return on_grid(force, grid), on_grid(height, grid), first, min(COUNT, end - first)


def by_place(force: FloatArray, height: FloatArray, first: int, count: int) -> float:
    """Return the skew by height and twice integrated acceleration, which is what is kept."""
    window = skew_window(force, height, first, count)
    return np.nan if window is None else window.skew_s


def by_place_untapered(force: FloatArray, height: FloatArray, first: int, count: int) -> float:
    """Return the same without the taper, every frequency weighted by velocity."""
    here = slice(first, first + count)
    body = np.cumsum(force[here] - force[here].mean()) * STEP_S
    speed = body - 0.5 * STEP_S * (force[here] - force[here].mean())
    place = np.roll(np.cumsum(body) * STEP_S, 1)
    place[0] = 0.0
    open_by, _ = np.linalg.qr(np.vander(np.linspace(-1.0, 1.0, count), 3))
    columns = np.stack([place, -speed, height[here]], axis=1)
    bare = columns - open_by @ (open_by.T @ columns)
    (gain, late), *_ = np.linalg.lstsq(bare[:, :2], bare[:, 2], rcond=None)
    return float(late / gain)


def by_velocity(force: FloatArray, height: FloatArray, first: int, count: int) -> float:
    """Return the skew by the derivative of the height and the acceleration, integrated once."""
    here = slice(first, first + count)
    speed = np.gradient(height, STEP_S)[here]
    body = np.cumsum(force[here]) * STEP_S - 0.5 * force[here] * STEP_S
    open_by, _ = np.linalg.qr(np.vander(np.linspace(-1.0, 1.0, count), 3))
    columns = np.stack([body, -np.gradient(body, STEP_S), speed], axis=1)
    bare = columns - open_by @ (open_by.T @ columns)
    (gain, late), *_ = np.linalg.lstsq(bare[:, :2], bare[:, 2], rcond=None)
    return float(late / gain)


def by_spectrum(force: FloatArray, height: FloatArray, first: int, count: int) -> float:
    """Return the slope of the phase of the tapered cross spectrum, 1 to 20 Hz, by its power.

    Of height and twice integrated acceleration, since a taper on the acceleration itself is
    one of another swing.
    """
    here = slice(first, first + count)
    body = np.cumsum(np.cumsum(force[here] - force[here].mean())) * STEP_S**2
    open_by, _ = np.linalg.qr(np.vander(np.linspace(-1.0, 1.0, count), 3))
    places = np.stack([np.roll(body, 1)[1:], height[here][1:]], axis=1)
    open_by = np.linalg.qr(open_by[1:])[0]
    bare = places - open_by @ (open_by.T @ places)
    spectra = np.fft.rfft(bare * np.hanning(count - 1)[:, None], 4 * count, axis=0)
    hz = np.fft.rfftfreq(4 * count, STEP_S)
    band = (hz >= 1.0) & (hz <= 20.0)
    cross = (spectra[:, 0] * np.conj(spectra[:, 1]))[band]
    omega, weight = 2 * np.pi * hz[band], np.abs(cross)
    return float(np.sum(weight * omega * np.angle(cross)) / np.sum(weight * omega**2))


ESTIMATORS: dict[str, Callable[[FloatArray, FloatArray, int, int], float]] = {
    "height against acceleration, integrated twice, tapered (kept)": by_place,
    "the same, not tapered": by_place_untapered,
    "its derivative against acceleration, integrated once": by_velocity,
    "phase of the tapered cross spectrum, 1 to 20 Hz": by_spectrum,
}


def drawn_table() -> None:
    """Print how the estimators do where drawn stops begin, and the whole."""
    errors: dict[str, list[float]] = {name: [] for name in ESTIMATORS}
    known: list[tuple[float, float]] = []
    for vehicle, recording in drawn_stops():
        skew = sensor_skew(*parts(recording))
        if skew.known:
            known.append((skew.skew_s - HOLD_S, skew.sigma_s))
        if vehicle != "minivan":
            series = stopping(recording)
            for name, estimate in ESTIMATORS.items():
                errors[name].append(estimate(*series) - HOLD_S)
    for name, found in errors.items():
        size = 1e3 * np.abs(found)
        print(f"| {name} | {np.median(size):.2f} | {size.max():.2f} |")
    off, sigma = 1e3 * np.array(known).T
    print(
        f"\nof {DRAWN} stops {off.size} tell it; largest error {np.abs(off).max():.2f} ms, root "
        f"mean square {np.sqrt(np.mean(off**2)):.2f} ms; in standard deviations "
        f"{np.sqrt(np.mean((off / sigma) ** 2)):.2f}, at most {np.abs(off / sigma).max():.2f}"
    )


def main() -> None:
    """Print the tables."""
    print("| run | found, ms | largest error of six shifts, ms | warned at |\n|---|---|---|---|")
    for name in ("bounce", "quiescent", *RUNS):
        print(run_row(name), flush=True)
    print("\n| estimator | median error, ms | largest |\n|---|---|---|")
    drawn_table()


if __name__ == "__main__":
    main()
