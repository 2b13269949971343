"""Readings of gnss_height that are not valid: stuck, with jumps, or never RTK fixed."""

from collections.abc import Iterator

import numpy as np

from floatref.screening.damage.damaged_samples import NONE
from floatref.screening.gnss_readings import RTK_FIXED, fixed_readings, usual_step
from floatref.screening.imu_channels import STEPS, describe_spans
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Recording

UNFIXED_S = 1.0
"""Time in s without a fixed reading from which a warning is given."""
STUCK_S, STUCK = 2.0, 5
"""A height is stuck if it is constant for this time in s and this number of readings while
something moves."""
UNUSUAL = 20.0
"""Length of a stuck run, in usual lengths of runs of identical readings."""
VELOCITY, ANGLE, TRAVEL_M, ALIVE = 0.01, 1e-3, 0.5, 0.1
"""Smallest motion meanwhile: vertical velocity in m/s, attitude in rad, or a distance in m with a
spread of the vertical force in m/s²."""
LOOKED_S = 20.0
"""Part of a stuck stretch, in s, that is searched for motion."""
JUMP_M, UNEXPLAINED = 0.2, 8.0
"""Smallest residual of a jump against the vertical velocity, in m and in usual residuals."""


def report_unfixed(recording: Recording, begin_s: float, end_s: float) -> Iterator[str]:
    """Yield a line if readings between ``begin_s`` and ``end_s`` are not RTK fixed."""
    quality = recording.find("gnss_quality")
    if quality is None:
        yield "channel gnss_quality: missing; every reading of gnss_height is taken as RTK fixed"
    times = recording.channel("gnss_height").times_s[fixed_readings(recording)]
    times = times[(times >= begin_s) & (times <= end_s)]
    if not times.size:
        kind = "" if quality is None else f", mostly {_most(quality.values)}"
        yield (
            f"channel gnss_quality: never {RTK_FIXED:g} (RTK fixed){kind}; gnss_height is not "
            "used, constants take its place; check the corrections that the receiver gets"
        )
        return
    edges = np.concatenate([[begin_s], times, [end_s]])
    step = usual_step(recording.channel("gnss_height").times_s)
    wide = np.flatnonzero(np.diff(edges) > max(UNFIXED_S, STEPS * step))
    if wide.size:
        spans = np.stack([edges[wide], edges[wide + 1]], axis=1)
        yield (
            f"channel gnss_height: no RTK-fixed reading for {describe_spans(spans)}; constants "
            "take its place"
        )


def _most(values: FloatArray) -> str:
    kinds, counts = np.unique(values[~np.isnan(values)], return_counts=True)
    return f"{kinds[np.argmax(counts)]:g}" if kinds.size else "missing"


def gnss_faults(recording: Recording) -> IndexArray:
    """Return which readings of gnss_height are stuck: shape (k, 2), first and the one behind.

    The height repeats itself bit by bit for `STUCK_S`, far longer than usual, while the antenna's
    velocity or attitude changes, or the vehicle drives over a road that moves it.
    """
    channel = recording.find("gnss_height")
    if channel is None or channel.values.size < STUCK:
        return NONE
    values, times = channel.values, channel.times_s
    edges = np.concatenate([[0], np.flatnonzero(np.diff(values) != 0) + 1, [values.size]])
    lengths = np.diff(edges)
    first, behind = edges[:-1], edges[1:]
    lasts = times[behind - 1] - times[first] >= STUCK_S
    chosen = lasts & (lengths >= STUCK) & (lengths >= UNUSUAL * _usual(lengths))
    moving = [
        bool(chosen[k]) and _moves(recording, times[first[k]], times[behind[k] - 1])
        for k in range(lengths.size)
    ]
    return np.stack([first, behind], axis=1)[np.array(moving, dtype=np.bool_)]


def _usual(lengths: IndexArray) -> FloatArray:
    """Return for each run of identical readings the run length within which half of others lie."""
    order = np.sort(lengths)
    total = np.cumsum(order)
    middle = order[np.searchsorted(total, total[-1] / 2)]
    usual = np.full(lengths.size, float(middle))
    for k in np.flatnonzero(lengths * 4 > total[-1]):
        others = np.sort(np.delete(lengths, k))
        below = np.cumsum(others)
        usual[k] = others[np.searchsorted(below, below[-1] / 2)] if others.size else 0.0
    return usual


def _moves(recording: Recording, begin_s: float, end_s: float) -> bool:
    """Return whether antenna or vehicle moves in the first `LOOKED_S` of that time."""
    end_s = min(end_s, begin_s + LOOKED_S)
    limits = {"gnss_vertical_velocity": VELOCITY, "gnss_pitch": ANGLE, "gnss_roll": ANGLE}
    for name, limit in limits.items():
        if _spread(recording.find(name), begin_s, end_s) > limit:
            return True
    # A recording of the vehicle's response may have no height sensor.
    track = next((t for t in recording.tracks if recording.find("height", t)), recording.tracks[0])
    force = _spread(recording.find("vertical_specific_force", track), begin_s, end_s)
    return force > ALIVE and _spread(recording.find("distance", track), begin_s, end_s) > TRAVEL_M


def _spread(channel: Channel | None, begin_s: float, end_s: float) -> float:
    """Return the spread of the samples of that time; 0 without samples."""
    if channel is None:
        return 0.0
    clock = channel.clock
    if isinstance(clock, StampedClock):
        low, high = np.searchsorted(clock.times_s, [begin_s, end_s])
    else:
        low, high = np.ceil((np.array([begin_s, end_s]) - clock.start_s) * float(clock.rate))
    part = channel.values[max(int(low), 0) : max(int(high), 0)]
    known = part[~np.isnan(part)]
    return float(np.ptp(known)) if known.size else 0.0


def report_faults(recording: Recording, faults: IndexArray) -> Iterator[str]:
    """Yield a line on the stuck readings of gnss_height, if any."""
    if not faults.size:
        return
    channel = recording.channel("gnss_height")
    times = channel.times_s
    value = channel.values[faults[0, 0]]
    if faults[0, 1] - faults[0, 0] == channel.values.size:
        yield (
            f"channel gnss_height: every reading is {value:.6g} m, so it measures nothing; not "
            "used, check the receiver's output"
        )
        return
    spans = np.stack([times[faults[:, 0]], times[faults[:, 1] - 1]], axis=1)
    yield f"channel gnss_height: stuck for {describe_spans(spans)}; not used there"


def report_jumps(recording: Recording, faults: IndexArray) -> Iterator[str]:
    """Yield a line if gnss_height jumps from one fixed reading to the next.

    A jump is a step that gnss_vertical_velocity does not explain, over a second at most.
    """
    sound = fixed_readings(recording)
    for first, behind in faults:
        sound[first:behind] = False
    times, leaps = _leaps(recording, sound)
    if not leaps.size:
        return
    usual = 1.4826 * float(np.median(np.abs(leaps - np.median(leaps))))
    jump: BoolArray = np.abs(leaps) > max(JUMP_M, UNEXPLAINED * usual)
    if jump.any():
        at = int(np.argmax(np.abs(np.where(jump, leaps, 0.0))))
        places = "1 place" if jump.sum() == 1 else f"{jump.sum()} places"
        yield (
            f"channel gnss_height: jumps in {places}, most by {leaps[at]:.3g} m at "
            f"{times[at]:.6g} s, which gnss_vertical_velocity does not; the ambiguity may be "
            "wrong there, so check the profile around it"
        )


def _leaps(recording: Recording, sound: BoolArray) -> tuple[FloatArray, FloatArray]:
    """Return times in s, and the change in m of the height beyond its velocity."""
    height, velocity = (
        recording.channel(name) for name in ("gnss_height", "gnss_vertical_velocity")
    )
    known = ~np.isnan(velocity.values)
    times, values = height.times_s[sound], height.values[sound]
    if times.size < STUCK or not known.any():
        return np.empty(0), np.empty(0)
    rising = np.interp(times, velocity.times_s[known], velocity.values[known])
    steps = np.diff(times)
    near = steps <= max(UNFIXED_S, 1.5 * usual_step(height.times_s))
    leaps = np.diff(values) - (rising[1:] + rising[:-1]) / 2 * steps
    return times[1:][near], leaps[near]
