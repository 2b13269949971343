"""A vehicle that stands for twelve hours in a recording: its profile is that of a minute's stop.

Law: away from the stop the profile, less what a high-pass takes, differs from that of a stop of a
minute by less than its own 1-σ, or by 0.2 mm where there is none; and memory hardly grows with the
time.
"""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from floatref import Channel, Recording, StampedClock, UniformClock, process, write_recording
from floatref.files import read_recording
from floatref.measures import high_pass
from floatref_conformance.proving_ground import Scenario, simulate

pytestmark = [pytest.mark.slow, pytest.mark.nightly, pytest.mark.posix]
HOURS, PIECE_S, EVERY, INTERVAL_M, STOP_M, AROUND_M = 12, 20.0, 8, 0.05, 300.0, 20.0
ROOM_BYTES = 300e6
"""Beside that of the samples, which are 24 bytes each: as they are, aligned and filtered."""
DRIVE = Scenario(
    seed=1, manoeuvre="stop", event_at_m=STOP_M, speed_kmh=60.0, final_speed_kmh=60.0,
    dwell_s=60.0, length_m=650.0, rate_hz=1000.0, profile_interval_m=INTERVAL_M, tracks=("left",),
    response=False,
)  # fmt: skip
PIPELINES = {
    "auto": False,
    "temporal-adaptive-hpf-spatial-backward": False,
    "road-prior-smoother": False,
    "kalman-smoother-reflection": True,
}
"""And whether the drive has an inertial unit and GNSS."""
PEAK = """
import sys
from pathlib import Path
import floatref
floatref.process(floatref.read_recording(Path(sys.argv[2])), sys.argv[1])
status = Path("/proc/self/status").read_text()
print(next(line for line in status.splitlines() if line.startswith("VmHWM")).split()[1])
"""


def thin(channel: Channel) -> Channel:
    """Return a fast channel at an eighth of its rate."""
    clock, size = channel.clock, channel.values.size // EVERY * EVERY
    if not isinstance(clock, UniformClock) or clock.rate < 500:
        return channel
    if channel.id.name == "distance":
        values, start_s = channel.values[:size:EVERY].copy(), clock.start_s
    else:
        values = channel.values[:size].reshape(-1, EVERY).mean(axis=1)
        start_s = clock.start_s + (EVERY - 1) / 2 / float(clock.rate)
    return replace(channel, values=values, clock=UniformClock(clock.rate / EVERY, start_s))


def stand(channel: Channel, at_s: float, turns: int) -> Channel:
    """Return the channel with ``turns`` more pieces of standstill, of the noise that it has."""
    times = channel.times_s
    first, last = np.searchsorted(times, [at_s - PIECE_S / 2, at_s + PIECE_S / 2])
    part = channel.values[first:last]
    level = np.full(part.size * turns, np.median(part))
    if channel.id.name not in ("distance", "gnss_quality"):
        draw = np.random.default_rng(len(channel.id.name))
        level += np.std(np.diff(part)) / 2**0.5 * draw.standard_normal(level.size)
    values = np.concatenate([channel.values[:last], level, channel.values[last:]])
    if isinstance(channel.clock, UniformClock):
        return replace(channel, values=values)
    more = times[first:last] + PIECE_S * np.arange(1, turns + 1)[:, None]
    stamps = np.concatenate([times[:last], more.ravel(), times[last:] + PIECE_S * turns])
    return replace(channel, values=values, clock=StampedClock.of(stamps))


def drives(sensors: bool) -> tuple[Recording, Recording]:
    """Return the drive with a stop of a minute, and with one of twelve hours more."""
    made = simulate(replace(DRIVE, imu=sensors, gnss=sensors)).recording
    distance = made.channel("distance")
    moves = np.flatnonzero(np.diff(distance.values) > 0)
    rests = np.diff(distance.times_s[moves])
    at_s = distance.times_s[moves][np.argmax(rests)] + rests.max() / 2
    short = replace(made, channels=tuple(map(thin, made.channels)))
    turns = round(HOURS * 3600 / PIECE_S)
    longer = tuple(stand(channel, at_s, turns) for channel in short.channels)
    return short, replace(short, channels=longer)


@pytest.mark.parametrize("pipeline", PIPELINES)
def test_the_profile_is_that_of_a_short_stop(pipeline: str, tmp_path) -> None:
    short, long = drives(PIPELINES[pipeline])
    write_recording(long, tmp_path / "long")
    (one,), (other,) = (
        process(each, pipeline).tracks for each in (short, read_recording(tmp_path / "long"))
    )
    assert one.elevation.size == other.elevation.size
    away = np.abs(INTERVAL_M * np.arange(one.elevation.size) - STOP_M) > AROUND_M
    sure = away & one.valid & other.valid
    assert sure[away].mean() > 0.7
    apart = np.abs(high_pass(one.elevation, INTERVAL_M) - high_pass(other.elevation, INTERVAL_M))
    bound = np.full(apart.size, 2e-4) if other.sigma is None else other.sigma
    assert (apart[sure] <= bound[sure]).all()


@pytest.mark.parametrize("pipeline", [name for name in PIPELINES if name != "auto"])
def test_memory_hardly_grows_with_the_standstill(pipeline: str, tmp_path) -> None:
    peaks = []
    for name, recording in zip(("short", "long"), drives(PIPELINES[pipeline]), strict=True):
        write_recording(recording, tmp_path / name)
        command = [sys.executable, "-c", PEAK, pipeline, str(tmp_path / name)]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        peaks.append(1024 * int(done.stdout.split()[-1]))
    samples = sum(channel.values.size for channel in recording.channels)
    assert peaks[1] - peaks[0] < ROOM_BYTES + 24 * samples
