"""Which accelerometer of a body does not move with it: its sign, scale, lag, clock or stretches."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from floatref.screening.second_sensor.doubts import Doubt, names
from floatref.screening.second_sensor.fast_series import STEP_S, FastGrid
from floatref.screening.second_sensor.fitting import WINDOW_S
from floatref.screening.second_sensor.rigid_body import COHERENT, Body, Relation
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.channels import ChannelId

SCALE_OFF, UNUSABLE = 0.06, 0.3
"""Deviation of a gain from 1 that makes a profile wrong by more than 5 %, with 0.5 % for the scale
of each of two sensors; and one that is no tolerance but a wrong unit."""
LATE_STEPS = 2
"""Lag in steps of the grid, 10 ms, that is no latency of a recorder: it shifts the body's motion
at 1.5 Hz by 10 % of its size."""
SHARPER = 2.0
"""A lag is one if it leaves this number of times less unexplained."""
SUSPICIOUS, FLOOR = 3.0, 0.003
"""A sensor is examined if more is unexplained than these times what the others leave, and more."""
LOUD, SHARE = 8.0, 0.3
"""A window is faulty above this number of usual residuals and above this share of usual motion."""
WHOLE_RUN = 0.75
"""Share of the windows from which on a fault is one of the whole run."""
NOTHING = 0.5
"""An accelerometer of which less is the body's motion is of no use."""


@dataclass(frozen=True, eq=False)
class Suspect:
    """One or two accelerometers of which one is faulty.

    Attributes:
        channels: the suspects.
        own: how the first of them follows from the others.
        usual: share that the others leave unexplained of each other.
    """

    channels: tuple[ChannelId, ...]
    own: Relation
    usual: float


def body_doubts(body: Body, grid: FastGrid) -> Iterator[Doubt]:
    """Yield the faults of the accelerometers of ``body``, two or more, on ``grid``."""
    suspect = find_suspect(body)
    if suspect is None:
        return
    whole = _whole_run(body, suspect)
    if whole is not None:
        yield whole
        return
    yield from _stretches(suspect, grid)


def find_suspect(body: Body) -> Suspect | None:
    """Return the accelerometer without which the others agree best; of two, both.

    None if the others do not agree, so that nothing is known.
    """
    own = {name: _own(body, name) for name in body.forces}
    if len(own) == 2:
        (first, relation), (second, _) = own.items()
        return None if relation is None else Suspect((first, second), relation, 0.0)
    rest = {name: body.without(name) for name in own}
    agree = {
        name: max(relation.fit.left_over for relation in relations)
        for name, relations in rest.items()
        if relations and all(map(_holds, relations)) and own[name] is not None
    }
    if not agree:
        return None
    best = min(agree, key=agree.__getitem__)
    relation = own[best]
    return None if relation is None else Suspect((best,), relation, agree[best])


def _own(body: Body, name: ChannelId) -> Relation | None:
    return body.relate(name, [other for other in body.forces if other != name])


def _holds(relation: Relation) -> bool:
    return relation.fit.explained >= COHERENT and not relation.is_off(SCALE_OFF)


def _whole_run(body: Body, suspect: Suspect) -> Doubt | None:
    """Return the fault that lasts for the whole run, None if there is no such fault."""
    own = suspect.own
    limit = FLOOR + SUSPICIOUS * suspect.usual
    if 1.0 - own.fit.explained <= limit and not own.is_off(SCALE_OFF):
        return None
    steps, best = body.lag(suspect.channels[0])
    sharper = best is not None and 1.0 - own.fit.explained >= SHARPER * (1.0 - best.fit.explained)
    late = steps if sharper and abs(steps) >= LATE_STEPS else 0
    relation = best if late and best is not None else own
    if relation.fit.agreeing < 1.0 - WHOLE_RUN or relation.fit.explained < COHERENT:
        return _incoherent(suspect, relation)
    if relation.is_off(SCALE_OFF):
        return _scaled(suspect, relation.gain)
    return _late(suspect, late) if late else _drifting(body, suspect)


def _drifting(body: Body, suspect: Suspect) -> Doubt | None:
    """Return the doubt about a sensor whose lag grows along the run, None if it does not."""
    thirds = np.array_split(np.arange(body.known.size), 3)
    lags = []
    for third in (thirds[0], thirds[-1]):
        inside = np.isin(np.arange(body.known.size), third)
        steps, found = replace(body, known=body.known & inside).lag(suspect.channels[0])
        if found is None or found.fit.explained < COHERENT:
            return None
        lags.append(steps)
    if abs(lags[1] - lags[0]) < LATE_STEPS:
        return None
    return _doubt(
        suspect,
        f"its lag behind the other accelerometers of the body changes by "
        f"{1e3 * STEP_S * (lags[1] - lags[0]):.0f} ms along the run; it is on another clock, "
        "correct its rate_hz",
        False,
    )


def _incoherent(suspect: Suspect, relation: Relation) -> Doubt:
    share = 100.0 * max(relation.fit.explained, 0.0)
    return _doubt(
        suspect,
        f"only {share:.0f} % of it is the motion of the body that the other accelerometers "
        "measure; it is noise, filtered, saturated or on another clock: repair it, or leave the "
        "track out",
        relation.fit.explained < NOTHING,
    )


def _scaled(suspect: Suspect, gain: float) -> Doubt:
    what = (
        f"moves against the other accelerometers of the body, by {gain:.2f}; its sign is inverted, "
        "multiply by -1"
        if gain < 0
        else f"shows {gain:.3g} times the motion of the body that the other accelerometers "
        "measure; correct its unit or scale"
    )
    return _doubt(suspect, what, abs(gain - 1.0) > UNUSABLE)


def _late(suspect: Suspect, steps: int) -> Doubt:
    side = "later" if steps > 0 else "earlier"
    return _doubt(
        suspect,
        f"{abs(steps) * STEP_S * 1e3:.0f} ms {side} than the other accelerometers of the body; "
        "correct its start_s or its clock",
        False,
    )


def _doubt(suspect: Suspect, what: str, fatal: bool) -> Doubt:
    if len(suspect.channels) == 1:
        return Doubt(suspect.channels, f"channel {suspect.channels[0]}: {what}", fatal)
    line = f"channels {names(suspect.channels)}: contradict each other; the first {what}"
    return Doubt(suspect.channels, line, fatal)


def _stretches(suspect: Suspect, grid: FastGrid) -> Iterator[Doubt]:
    """Yield the stretches in which a sensor leaves the others."""
    spans = window_spans(suspect.own.fit.loud(LOUD, SHARE), grid)
    if not spans:
        return
    seconds = sum(end - begin for begin, end in spans)
    begin = spans[0][0]
    yield Doubt(
        suspect.channels,
        f"channel{'s' if len(suspect.channels) > 1 else ''} {names(suspect.channels)}: not the "
        f"motion of the body that the other accelerometers measure for {seconds:.3g} s in "
        f"{len(spans)} places, first from {begin:.6g} s; flagged",
        spans=spans,
        replaced=len(suspect.channels) == 1,
    )


def window_spans(where: BoolArray | FloatArray, grid: FastGrid) -> tuple[tuple[float, float], ...]:
    """Return begin and end in s of the windows ``where``, joined and one window longer each way."""
    wide = np.convolve(np.asarray(where, np.float64), np.ones(3), "same") > 0
    edges = np.flatnonzero(np.diff((wide & np.any(where)).astype(np.int8), prepend=0, append=0))
    times = grid.begin_s + WINDOW_S * edges
    return tuple((float(a), float(b)) for a, b in times.reshape(-1, 2))
