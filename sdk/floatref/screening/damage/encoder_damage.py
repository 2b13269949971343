"""Encoder samples that do not measure travel: steps back, jumps, silence, lost counts."""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.screening.damage.damaged_samples import NONE, Damage, describe_damage
from floatref.screening.damage.encoder_path import EncoderPath
from floatref.values.arrays import FloatArray, IndexArray, Records
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.encoder.plausible_distance import FASTEST_MPS
from floatref.values.recording import Channel

SOUND, SILENT, LEAPT, FAST, SLOW, STALLED = range(6)
"""Kinds of the distance to a knot: travelled, caught up at once after a silence, a jump, too many
counts, too few counts, no counts for too long."""
HARDEST = 2.0 * STANDARD_GRAVITY
"""Limit of braking and speeding up of any vehicle, in m/s²."""
UNEVEN = 0.2
"""A wheel that hops or is out of round is faster or slower than the vehicle by this share."""
MOVING_MPS = 2.5
"""Below this speed lost counts are not searched for; everything there is flagged as slow."""
LEAP = 5.0
"""A step of more than this number of usual steps, faster than `FASTEST_MPS`, is a jump."""
ROUGH = 1.5
"""Uncertainty of the distance between two knots, in usual steps."""
LATE = 2.5
"""A count is late after more than this number of usual intervals."""
SHORTEST_S, AT_ONCE = 0.02, 2.5
"""An encoder was silent if it was constant for this time in s, and then took more than this number
of usual steps."""
MADE_UP = 2.5
"""The step after a silence is the distance travelled meanwhile, within this factor."""


@compiled
def shortest_travel(speed: float, time_s: float) -> float:
    """Return the shortest distance in m that a vehicle at ``speed`` in m/s travels."""
    braked_s = min(time_s, max(speed, 0.0) / HARDEST)
    return (max(speed, 0.0) - 0.5 * HARDEST * braked_s) * braked_s


@compiled
def judge(
    ways: Records, before: FloatArray, off_m: float, usual_m: float, kinds: IndexArray
) -> None:
    """Write to ``kinds`` the kind of distance of every one of ``ways`` except the first.

    ``before`` is the distance, the time and the number of steps of two ways like the first;
    ``off_m`` the largest error of a knot, ``usual_m`` the usual step. A distance is judged by the
    two undamaged ones before it.
    """
    old_m, old_s, old_n = before
    new_m, new_s, new_n = before
    sound_t = ways[0].t
    for k in range(1, kinds.size):
        last, this = ways[k - 1], ways[k]
        start, way, took = last.t, this.far - last.far, this.t - last.t
        step, since_s, hidden = this.step, this.since_s, this.hidden
        speed = (old_m + new_m) / (old_s + new_s)
        local = max(usual_m, (old_m + new_m) / max(old_n + new_n, 1.0))
        unsure = off_m / (old_s + new_s) + HARDEST * (0.5 * (old_s + new_s) + start - sound_t)
        slowest = (1.0 - UNEVEN) * speed - unsure
        most = ((1.0 + UNEVEN) * speed + unsure + 0.5 * HARDEST * took) * took
        steep = step > max(FASTEST_MPS * this.step_s + LEAP * local, MADE_UP * speed * since_s)
        moving, at_gap = speed >= MOVING_MPS, slowest - HARDEST * (this.gap_t - start)
        stops = this.gap + hidden + off_m < shortest_travel(at_gap, this.gap_s)
        held = this.held_s > 0.0 and since_s >= SHORTEST_S
        kind = SOUND
        if moving and stops and speed * this.gap_s > LATE * local:
            kind = STALLED
        elif steep or way > min(most, FASTEST_MPS * took) + ROUGH * local:
            own = step - speed * this.step_s
            kind = LEAPT if own >= 0.5 * (way - speed * took) else FAST
        elif moving and way + hidden + ROUGH * local < shortest_travel(slowest, took):
            kind = SLOW
        elif held and step > AT_ONCE * local and step * MADE_UP > speed * since_s:
            kind = SILENT
        kinds[k] = kind
        if kind in (SOUND, SILENT):
            old_m, old_s, old_n = new_m, new_s, new_n
            new_m, new_s, new_n, sound_t = way, took, this.steps, this.t


OFF = 3.0
"""Largest error of a knot, in usual differences of neighbouring distances."""
FIRST = 9
"""Number of distances whose median gives the speed at the beginning."""
ONE_COUNT = 1.5
"""A sample up to this number of usual steps behind is a tremble by one count."""


def encoder_damage(channel: Channel) -> Damage:
    """Return which samples of a distance ``channel`` do not measure travel.

    Samples behind the farthest one so far, spikes, and a silence that the encoder catches up
    afterwards, are bridged. Jumps, and lost or surplus counts, are void, since a line does not give
    the travelled distance, and lasting: engines that the encoder triggers integrate over them.
    """
    path = EncoderPath.of(channel)
    kinds = _kinds(path)
    silent = path.between(kinds == SILENT, "front", "step")
    leapt = path.between(kinds == LEAPT, "before_step", "step")
    leapt[:, 1] = path.knots["step"][kinds == LEAPT] + 1
    fast = path.up_to(kinds == FAST)
    stalled = path.between(kinds == STALLED, "gap", "after_gap")
    lost = merge_stretches(stalled, path.up_to(kinds == SLOW))
    deep = merge_stretches(path.behind[path.depths > ONE_COUNT * path.usual_m])
    void = merge_stretches(leapt, fast, lost)
    faults = (
        (deep, "goes back"),
        (silent, "silent and caught up"),
        (leapt, "leaps"),
        (merge_stretches(fast), "counts too much"),
        (lost, "loses counts"),
    )
    lines = tuple(describe_damage(channel, spans, what) for spans, what in faults if spans.size)
    return Damage(merge_stretches(path.behind, silent), void, void, lines)


def _kinds(path: EncoderPath) -> IndexArray:
    """Return the kind of the distance to every knot of ``path``, as `judge` gives it."""
    kinds = np.zeros(len(path.knots), np.int64)
    if kinds.size < 3:
        return kinds
    ways = path.ways()
    took, far = np.diff(ways["t"]), np.diff(ways["far"])
    uneven = np.abs(far[1:] - far[:-1] * took[1:] / took[:-1])
    off_m = min(OFF * float(np.median(uneven)), path.usual_m)
    first_s = float(np.sum(took[:FIRST]))
    speed = float(np.median(far[:FIRST] / took[:FIRST]))
    steps = float(np.sum(ways["steps"][1 : FIRST + 1]))
    before = np.array([speed * first_s, first_s, steps]) / 2
    judge(ways, before, off_m, path.usual_m, kinds)
    return kinds


def merge_stretches(*spans: IndexArray) -> IndexArray:
    """Return stretches, shape (k, 2), in order; those that overlap or touch are joined."""
    joined = np.concatenate([NONE, *spans])
    joined = joined[np.argsort(joined[:, 0], kind="stable")]
    ends = np.maximum.accumulate(joined[:, 1])
    starts = np.append(True, joined[1:, 0] > ends[:-1])[: len(joined)]
    return np.stack([joined[starts, 0], ends[np.append(starts[1:], True)[: len(joined)]]], axis=1)
