"""A bouncing vehicle stops on a flat road: results of cascade and observer.

    python matched_high_pass.py OUT.png

Prints the largest elevation that each finds on the flat road, and draws it over the distance;
then the roughest 7.62 m that each makes of the accelerometer's tilt in the brake.
"""

import sys

import numpy as np
from matplotlib.figure import Figure

import floatref
from floatref import short_interval_roughness

RATE_HZ, INTERVAL_M, G = 4000.0, 0.025, 9.80665
TOP_MPS, TO_START_S, TO_STOP_S, STANDING_S = 20.0, 8.0, 5.0, 4.0
LEGS = (
    *((1.0, 0.0, 0.0), (TO_START_S, 0.0, TOP_MPS), (20.0, TOP_MPS, TOP_MPS)),
    *((TO_STOP_S, TOP_MPS, 0.0), (STANDING_S, 0.0, 0.0)),
    *((TO_START_S, 0.0, TOP_MPS), (20.0, TOP_MPS, TOP_MPS)),
)
"""Duration in s and the speeds between which it changes smoothly."""
BEGINS = np.cumsum([0.0, *(leg[0] for leg in LEGS)])
BOUNCE_M, BOUNCE_HZ, DIVE_M, TILT = 0.05, 2.0, 0.025, 0.1
"""The last is the error of the tilted accelerometer, in m/s²."""
PIPELINES = (
    "temporal-adaptive-hpf",
    "temporal-adaptive-hpf-spatial-backward",
    "temporal-matched-hpf",
)
GREEN = "#009E73"
STYLES = (
    {"color": "#D55E00", "linestyle": ":"},
    {"color": "0.1", "linestyle": ":", "zorder": 3},
    {"color": "#E69F00"},
    {"color": "#D55E00"},
    {"color": "#0072B2"},
)
"""Of both forward passes and of the pipelines."""


def travelled(times):
    """Return distance in m and speed in m/s."""
    distance, speed = np.zeros(times.size), np.zeros(times.size)
    for begin, (duration, first, last) in zip(BEGINS, LEGS, strict=False):
        past = np.clip(times - begin, 0.0, duration)
        turn = 2.0 * np.pi * past / duration
        rise = (turn - np.sin(turn)) / (2.0 * np.pi)
        area = (turn**2 / 2.0 + np.cos(turn) - 1.0) / (2.0 * np.pi) ** 2
        distance += first * past + (last - first) * duration * area
        within = (times >= begin) & (times <= begin + duration)
        speed[within] = (first + (last - first) * rise)[within]
    # Rounding must not turn the encoder back.
    return np.maximum.accumulate(distance), speed


def swelling(times, begin, duration, hertz=0.0):
    """Return sin⁴ of half a turn times a cosine of ``hertz``, and its second derivative."""
    past = times - begin
    within = (past >= 0.0) & (past <= duration)
    motion, acceleration = np.zeros(times.size), np.zeros(times.size)
    for k, weight in zip(range(-2, 3), (1.0, -4.0, 6.0, -4.0, 1.0), strict=True):
        w = 2.0 * np.pi * (hertz + k / duration)
        part = weight / 16.0 * np.cos(w * past[within])
        motion[within] += part
        acceleration[within] -= w**2 * part
    return motion, acceleration


def drive():
    """Return times, distance and speed, the vehicle's motion and its vertical acceleration."""
    times = np.arange(round(BEGINS[-1] * RATE_HZ)) / RATE_HZ
    bounce = swelling(times, 1.0, BEGINS[-1] - 2.0, BOUNCE_HZ)
    dive = swelling(times, BEGINS[3], TO_STOP_S + 0.5)
    motion, acceleration = (BOUNCE_M * b - DIVE_M * d for b, d in zip(bounce, dive, strict=True))
    return times, *travelled(times), motion, acceleration


def integral(x):
    """Return the trapezoidal integral over time."""
    return np.concatenate(([0.0], np.cumsum(x[1:] + x[:-1]))) / (2.0 * RATE_HZ)


def forward_passes(acceleration, height, distance):
    """Return the elevation in m against time before any backward pass: cascade, observer."""
    speed = floatref.TravelSpeed(RATE_HZ).of(distance)
    high_pass = floatref.AdaptiveHighPass(RATE_HZ)
    velocity = integral(high_pass.acceleration(acceleration, speed))
    reference = integral(high_pass.velocity(velocity, speed))
    observer = floatref.MatchedHighPass(RATE_HZ)
    return {
        "cascade, forward only": reference - high_pass.height(height, speed),
        "observer, forward only": observer.reference_height(acceleration, height, speed) - height,
    }


def profiles(acceleration, height, distance):
    """Return the profile of every pipeline."""
    clock = floatref.UniformClock.of(RATE_HZ)
    channels = (
        floatref.Channel.of("vertical_specific_force", G + acceleration, clock),
        floatref.Channel.of("height", height, clock),
        floatref.Channel.of("distance", distance, clock),
    )
    recording = floatref.Recording(channels, floatref.Setup(profile_interval_m=INTERVAL_M))
    return {name: floatref.process(recording, name) for name in PIPELINES}


def elevations(acceleration, height, distance):
    """Return distance and elevation of both forward passes and of every pipeline, in m."""
    forward = forward_passes(acceleration, height, distance)
    found = {name: (distance, elevation) for name, elevation in forward.items()}
    for name, profile in profiles(acceleration, height, distance).items():
        found[name] = profile.distance_m, profile.tracks[0].elevation
    return found


def roughest(profile):
    """Return the highest short-interval roughness in m/km."""
    return short_interval_roughness(profile.tracks[0].elevation, INTERVAL_M).max()


def heights(distance, elevation, metres=5.0):
    """Return the largest elevation in mm of every stretch of road, and where the stretches end."""
    starts = np.searchsorted(distance, np.arange(distance[0], distance[-1], metres))
    ends = np.append(distance[starts[1:]], distance[-1])
    return ends, 1000.0 * np.maximum.reduceat(np.abs(elevation), starts)


def draw_drive(axes, times, speed):
    """Draw speed and cut-off against time."""
    axes.set_title("Flat road, 50 mm of bounce at 2 Hz, 25 mm of dive in the brake")
    axes.plot(times, speed, color="0.25")
    axes.set(xlabel="Time (s)", ylabel="Speed (m/s)", xlim=(0.0, times[-1]), ylim=(0.0, 24.0))
    beside = axes.twinx()
    beside.plot(times, floatref.AdaptiveCutOff().frequency(speed), color=GREEN)
    beside.set_ylim(0.0, 0.54)
    beside.set_ylabel("Cut-off (Hz)", color=GREEN)
    beside.tick_params(axis="y", colors=GREEN)


def draw_elevations(axes, found, stop_m):
    """Draw the results against distance."""
    for (name, (distance, elevation)), style in zip(found.items(), STYLES, strict=True):
        axes.semilogy(*heights(distance, elevation), **style, label=name)
    axes.axvline(stop_m, color="0.6", linewidth=0.8, zorder=0)
    axes.text(stop_m, 3e3, " stop", color="0.4", va="center")
    axes.set(xlabel="Distance (m)", ylabel="Elevation found, largest of every 5 m (mm)")
    axes.set(xlim=(0.0, distance[-1]), ylim=(1e-9, 1e4))
    axes.grid(alpha=0.3)
    axes.legend(loc="lower center", fontsize="small")


def main(path):
    """Print the table and write the picture to ``path``."""
    times, distance, speed, motion, acceleration = drive()
    found = elevations(acceleration, 0.3 + motion, distance)
    error = TILT * swelling(times, BEGINS[3], TO_STOP_S)[0]
    tilted = profiles(error, np.full(times.size, 0.3), distance)
    print(f"{'on a flat road':38}  motion, mm  tilt, m/km")
    for name, (_, elevation) in found.items():
        shown = f"{roughest(tilted[name]):.1f}" if name in tilted else "–"
        print(f"{name:38}  {1000.0 * np.abs(elevation).max():10.3g}  {shown:>10}")
    figure = Figure(figsize=(9.0, 7.6), layout="constrained")
    above, below = figure.subplots(2, 1, height_ratios=(1.0, 1.9))
    draw_drive(above, times, speed)
    draw_elevations(below, found, np.interp(BEGINS[4], times, distance))
    figure.savefig(path, dpi=130)


if __name__ == "__main__":
    main(sys.argv[1])
