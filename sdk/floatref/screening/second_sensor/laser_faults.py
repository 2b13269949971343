"""Which laser does not measure the road that the wheel beside it rolls on."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from floatref.screening.second_sensor.body_faults import UNUSABLE, window_spans
from floatref.screening.second_sensor.doubts import Doubt, names
from floatref.screening.second_sensor.fast_series import FastGrid
from floatref.screening.second_sensor.fitting import FEWEST_WINDOWS, Fit
from floatref.screening.second_sensor.road_twice import (
    COHERENT,
    LaserFit,
    TwoRoads,
    fit_laser,
)
from floatref.values.arrays import BoolArray
from floatref.values.channels import ChannelId

FORCE, HEIGHT = "vertical_specific_force", "height"
SCALE_APART = 0.1
"""Largest difference of the gains of two lasers: 5 % of a profile, 0.5 % for the scale of each of
four sensors, and 3 % for springs that rub on one side more than on the other."""
LOWEST, HIGHEST = 0.5, 1.5
"""Gain of a laser alone: a wheel that rubs or rolls beside its line takes up to 0.3 off it."""
LATE_S, APART_S = 0.03, 0.008
"""Lag in s of a laser alone that is no latency, and of one against the other."""
MORE, FLOOR = 3.0, 0.05
"""A faulty laser leaves this number of times more unexplained than the other, and more."""
LOUD, SHARE = 6.0, 0.5
"""A window is faulty above this number of usual residuals and above this share of usual motion."""
QUIET = 4.0
"""The other wheel path is at most at this number of usual residuals in such a window."""
MOSTLY = 0.6
"""Share of the windows behind a place that disagree, and of those before it that do not, if a laser
fails there."""
FAILS, WORKS = 0.8, 0.9
"""A laser fails if fewer than the first share of its windows agree, and more than the second share
of the other's: humps disturb both."""
LEAST = 0.65
"""Least share that is explained for a working laser: rubbing springs leave 0.8."""
NOTHING = 0.7
"""A laser of which less is explained is of no use; of noise alone, accelerometers explain 0.5."""


def laser_doubts(roads: Mapping[str, TwoRoads], grid: FastGrid) -> Iterator[Doubt]:
    """Yield the faults of the lasers of all wheel paths in ``roads``, on ``grid``."""
    found = {track: fit_laser(each) for track, each in roads.items()}
    known = {track: each for track, each in found.items() if each is not None}
    if len(known) == 2:
        swapped = _exchanged(roads, known)
        if swapped is not None:
            yield swapped
            return
    for track, own in known.items():
        other = next((each for name, each in known.items() if name != track), None)
        doubt = _whole_run(track, own, other)
        if doubt is not None:
            yield doubt
        elif own.on_time.explained >= LEAST:
            yield from _stretches(track, own, other, grid)


def _whole_run(track: str, own: LaserFit, other: LaserFit | None) -> Doubt | None:
    """Return the fault of the laser of ``track`` that lasts for the whole run, None without."""
    if other is not None and not _is_sound(other):
        # If neither fits, the encoder or the wheels may be at fault.
        return None if _is_sound(own) else _unlike(track, own) if _is_better(other, own) else None
    name = ChannelId(HEIGHT, track)
    if own.gain < 0 and own.fit.explained >= NOTHING:
        return _inverted(name, own.gain)
    if own.fit.explained < LEAST or _leaves_more(own, other):
        return _unlike(track, own)
    return _scaled(name, own, other) or _late(name, own, other)


def _inverted(name: ChannelId, gain: float) -> Doubt:
    line = f"channel {name}: shows the wheel's road with its sign inverted (gain {gain:.2f})"
    return Doubt((name,), f"{line}; multiply changes of the range by -1", True)


def _is_sound(own: LaserFit) -> bool:
    return min(own.fit.explained, own.on_time.explained) >= LEAST and own.gain > 0


def _is_better(one: LaserFit, other: LaserFit) -> bool:
    return one.fit.explained > other.fit.explained


def _leaves_more(own: LaserFit, other: LaserFit | None) -> bool:
    if other is None:
        return False
    left = 1.0 - own.fit.explained
    return left > max(MORE * (1.0 - other.fit.explained), FLOOR)


def _unlike(track: str, own: LaserFit) -> Doubt:
    name, share = ChannelId(HEIGHT, track), 100.0 * max(own.fit.explained, 0.0)
    return Doubt(
        (name,),
        f"channel {name}: it and its accelerometer explain {share:.0f} % of the road under the "
        "wheel; the laser is noise, stuck, filtered, of another scale or on another clock: "
        "repair it, or leave the track out",
        own.fit.explained < NOTHING,
    )


def _scaled(name: ChannelId, own: LaserFit, other: LaserFit | None) -> Doubt | None:
    gain = own.gain if other is None else own.gain / other.gain
    low, high = (LOWEST, HIGHEST) if other is None else (1 / (1 + SCALE_APART), 1 + SCALE_APART)
    if low <= gain <= high or (other is not None and _is_nearer(own, other)):
        return None
    against = "the wheel" if other is None else "the other laser"
    return Doubt(
        (name,),
        f"channel {name}: {gain:.3g} times the range that the road of its wheel gives, against "
        f"{against}; correct its unit or scale, or that of its accelerometer",
        abs(gain - 1.0) > UNUSABLE,
    )


def _is_nearer(own: LaserFit, other: LaserFit) -> bool:
    """Return whether ``own`` is certainly the sound one of two lasers of different gains."""
    apart, beside = abs(np.log(own.gain)), abs(np.log(other.gain))
    return bool(apart < 0.5 * beside)


def _late(name: ChannelId, own: LaserFit, other: LaserFit | None) -> Doubt | None:
    late_s = own.late_s if other is None else own.late_s - other.late_s
    limit = LATE_S if other is None else APART_S
    if abs(late_s) < limit or (other is not None and abs(own.late_s) < abs(other.late_s)):
        return None
    side = "later" if late_s > 0 else "earlier"
    return Doubt(
        (name,),
        f"channel {name}: {1e3 * abs(late_s):.0f} ms {side} than its accelerometer, by the "
        "road that the wheel rolls on; correct its start_s or its clock",
    )


def _exchanged(roads: Mapping[str, TwoRoads], own: Mapping[str, LaserFit]) -> Doubt | None:
    """Return the doubt about two sensors of which each fits the other wheel path."""
    if all(each.fit.explained >= COHERENT for each in own.values()):
        return None
    first, second = roads.values()
    for sensor, crossed in (
        (HEIGHT, (replace(first, height=second.height), replace(second, height=first.height))),
        (FORCE, (replace(first, lift=second.lift), replace(second, lift=first.lift))),
    ):
        found = [fit_laser(each) for each in crossed]
        if all(each is not None and _is_sound(each) for each in found):
            both = tuple(ChannelId(sensor, track) for track in roads)
            line = f"channels {names(both)}: exchanged, each belongs to the other wheel path"
            return Doubt(both, f"{line}; swap them", True)
    return None


def _to_the_end(own: Fit, other: Fit | None) -> BoolArray:
    """Return the windows from which on the laser mostly disagrees, if it mostly agreed before.

    Windows in which the other laser disagrees, too, are the road's.
    """
    sound = np.ones(own.agree.size, np.bool_) if other is None else other.agree
    index = np.flatnonzero(own.counted & sound)
    off = ~own.agree[index]
    behind = np.cumsum(off[::-1])[::-1] / np.arange(off.size, 0, -1)
    before = (np.cumsum(off) - off) / np.maximum(np.arange(off.size), 1)
    changes = off & (behind >= MOSTLY) & (before <= 1.0 - MOSTLY)
    changes[: FEWEST_WINDOWS // 2] = changes[max(off.size - FEWEST_WINDOWS, 0) :] = False
    if not changes.any():
        return np.zeros(own.agree.size, np.bool_)
    return np.asarray(np.arange(own.agree.size) >= index[int(np.argmax(changes))])


def _stretches(
    track: str, own: LaserFit, other: LaserFit | None, grid: FastGrid
) -> Iterator[Doubt]:
    """Yield the stretches in which a laser leaves the road while the other one does not."""
    loud: BoolArray = own.on_time.loud(LOUD, SHARE)
    if other is not None:
        loud = loud & ~other.on_time.loud(QUIET, 0.0)
    # A joint or a patch that the tyre bridges lasts for less.
    loud = loud & (np.append(loud[1:], False) | np.append(False, loud[:-1]))
    loud = loud | _to_the_end(own.on_time, None if other is None else other.on_time)
    spans = window_spans(loud, grid)
    if not spans:
        if own.on_time.agreeing < FAILS and (other is None or other.on_time.agreeing > WORKS):
            yield replace(_unlike(track, own), fatal=False)
        return
    name = ChannelId(HEIGHT, track)
    seconds = sum(end - begin for begin, end in spans)
    yield Doubt(
        (name,),
        f"channel {name}: not the road that the wheel rolls on for {seconds:.3g} s in {len(spans)} "
        f"places, first from {spans[0][0]:.6g} s; flagged",
        spans=spans,
        replaced=True,
    )
