"""Clocks aligned by what they share: the clocks that were drawn come back."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.clocks.clock_alignment import Alignment, align_by_pps, align_by_pulses
from floatref.measures.clocks.clock_line import CURVED_S
from floatref_reference.chapter_4 import section_4_4_clocks as reference

FEW = settings(deadline=None, max_examples=40)
seeds = st.integers(0, 2**32 - 1)
offsets = st.floats(-1e4, 1e4)
drifts = st.floats(-2e-4, 2e-4)


class Trains:
    """Pulses of a base clock and as another clock saw them."""

    def __init__(self, rng, times, offset, drift, jitter, lost=0.1, false=0.05) -> None:
        own = (times - offset) / (1 + drift)
        self.true_own = own
        self.own = self._seen(rng, own + rng.uniform(-jitter, jitter, own.size), lost, false)
        base = times + rng.uniform(-jitter, jitter, times.size)
        self.base = self._seen(rng, base, lost, false)

    @staticmethod
    def _seen(rng, times, lost, false):
        kept = times[rng.random(times.size) >= lost]
        extra = rng.uniform(times[0], times[-1], rng.binomial(times.size, false))
        apart = np.abs(extra[:, None] - times).min(axis=1) > 0.1
        return np.sort(np.concatenate([kept, extra[apart]]))


def irregular(rng, count: int) -> np.ndarray:
    return np.cumsum(rng.uniform(1.0, 7.0, count))


def off(found: Alignment, own: np.ndarray, offset: float, drift: float) -> float:
    return float(np.abs(found.to_base(own) - (offset + (1 + drift) * own)).max())


@pytest.mark.slow
@FEW
@given(seed=seeds, offset=offsets, drift=drifts, jitter=st.sampled_from([0.0, 1e-5, 5e-4, 4e-3]))
def test_irregular_pulses_tell_any_offset(seed, offset, drift, jitter) -> None:
    rng = np.random.default_rng(seed)
    trains = Trains(rng, irregular(rng, 80), offset, drift, jitter)
    found = align_by_pulses(trains.own, trains.base)
    assert off(found, trains.true_own, offset, drift) <= 1.2 * jitter + 1e-8
    assert abs(found.drift - drift) <= 5 * found.drift_sigma + 1e-11
    assert found.residual_s <= 1.2 * jitter + 1e-8
    assert found.pairs + found.dropped == trains.own.size
    # More jitter than a curve's least residual may look like a curve: one time in thousands.
    assert jitter > CURVED_S or found.warnings == ()


@pytest.mark.slow
def test_jitter_alone_is_seldom_taken_for_a_curve() -> None:
    rngs = map(np.random.default_rng, range(400))
    trains = [Trains(rng, irregular(rng, 80), 0.0, 0.0, 5e-4) for rng in rngs]
    assert sum(align_by_pulses(t.own, t.base).warnings != () for t in trains) <= 4


@pytest.mark.slow
@FEW
@given(
    seed=seeds, offset=offsets, drift=drifts, ahead=st.integers(0, 40), behind=st.integers(0, 40)
)
@example(seed=410, offset=0.0, drift=0.0, ahead=38, behind=38)
def test_streams_begin_and_end_where_they_like(seed, offset, drift, ahead, behind) -> None:
    """Six pulses in common are enough; with fewer a refusal is right as well.

    The few that the longest pieces share are far from most times: the error there is that of the
    drift, six of its own σ at most.
    """
    rng = np.random.default_rng(seed)
    trains = Trains(rng, irregular(rng, 100), offset, drift, 1e-4)
    own, base = trains.own[ahead:], trains.base[: trains.base.size - behind]
    try:
        found = align_by_pulses(own, base)
    except InputError:
        again = (base - offset) / (1 + drift)
        assert np.count_nonzero(np.abs(own[:, None] - again).min(axis=1) < 1e-3) < 6
        return
    error = found.to_base(trains.true_own) - (offset + (1 + drift) * trains.true_own)
    away_s = np.abs(trains.true_own - np.mean(found.between_s))
    # What is taken for a curve goes on in its own direction beyond the pulses, with a warning.
    assert found.warnings or (np.abs(error) <= 1e-3 + 6 * found.drift_sigma * away_s).all()


@pytest.mark.slow
@FEW
@given(
    seed=seeds,
    drift=drifts,
    shift=st.integers(-30, 30),
    guess=st.floats(-1.5, 1.5),
    hours=st.sampled_from([0.05, 1.0]),
)
def test_periodic_pulses_take_the_nearest_shift_and_say_so(
    seed, drift, shift, guess, hours
) -> None:
    rng = np.random.default_rng(seed)
    times = 4.0 * np.arange(int(hours * 900)) + 1000.0
    offset = 4.0 * shift + 0.3
    trains = Trains(rng, times, offset, drift, 1e-4)
    begin = trains.true_own[0]
    found = align_by_pulses(trains.own, trains.base, offset + drift * begin + guess)
    assert off(found, trains.true_own, offset, drift) <= 1e-3
    (line,) = found.warnings
    assert line.startswith("the pulses repeat every 4 s; of the shifts that fit")


def test_between_two_shifts_an_offset_has_to_be_stated() -> None:
    with pytest.raises(InputError, match=r"lies between them; state an offset within 1\.6 s"):
        align_by_pulses(4.0 * np.arange(50), 4.0 * np.arange(50) + 0.1, near_s=2.1)


@pytest.mark.slow
@pytest.mark.cites("section 4.4")
@settings(deadline=None, max_examples=15)
@given(
    seed=seeds, offset=st.floats(-50.0, 50.0), drift=drifts, jitter=st.sampled_from([1e-5, 1e-3])
)
def test_it_is_the_line_of_the_reference(seed, offset, drift, jitter) -> None:
    rng = np.random.default_rng(seed)
    trains = Trains(rng, irregular(rng, 22), offset, drift, jitter)
    found = align_by_pulses(trains.own, trains.base)
    shift = reference.shift_of_most(trains.own, trains.base, 0.03)
    rough = reference.line(*reference.pairs(trains.own, trains.base, shift, 0.0, 0.05))
    line = reference.line(*reference.pairs(trains.own, trains.base, *rough[:2], 0.01))
    expected = reference.common_clock(trains.own, line.offset, line.drift).astype(float)
    assert np.abs(found.to_base(trains.own) - expected).max() < 1e-9
    assert found.offset_s == pytest.approx(float(line.offset), abs=1e-9)
    assert found.drift_sigma == pytest.approx(float(line.sigma), rel=1e-6)
    assert found.residual_s == pytest.approx(float(line.residual), rel=1e-6)


@pytest.mark.slow
@FEW
@given(seed=seeds, offset=offsets, amplitude=st.floats(1e-3, 5e-3))
def test_a_drift_that_changes_is_followed_between_the_pulses(seed, offset, amplitude) -> None:
    rng = np.random.default_rng(seed)
    own = irregular(rng, 200)
    wander = amplitude * np.sin(2 * np.pi * own / own[-1])
    base = offset + own + wander + rng.uniform(-1e-5, 1e-5, own.size)
    found = align_by_pulses(own, base)
    assert not found.uniform
    assert "the drift is not constant" in found.warnings[-1]
    between = np.linspace(own[0], own[-1], 5000)
    true = offset + between + amplitude * np.sin(2 * np.pi * between / own[-1])
    assert np.abs(found.to_base(between) - true).max() < 5e-5
    assert (np.diff(found.to_base(np.linspace(own[0] - 50, own[-1] + 50, 5000))) > 0).all()


@FEW
@given(seed=seeds, drift=drifts, count=st.integers(5, 120))
def test_jitter_alone_bends_nothing(seed, drift, count) -> None:
    rng = np.random.default_rng(seed)
    own = irregular(rng, count)
    found = align_by_pulses(own, (1 + drift) * own + rng.uniform(-5e-3, 5e-3, count))
    assert found.uniform
    assert found.warnings == ()


@pytest.mark.slow
@FEW
@given(seed=seeds, offset=offsets, drift=drifts, bad=st.lists(st.integers(2, 57), max_size=5))
def test_pulses_that_are_off_move_nothing(seed, offset, drift, bad) -> None:
    """Off by 8 to 15 ms they are taken for the same pulse, and left out of the line."""
    rng = np.random.default_rng(seed)
    own = irregular(rng, 60)
    base = offset + (1 + drift) * own + rng.uniform(-1e-5, 1e-5, own.size)
    base[bad] += rng.choice([-1.0, 1.0], len(bad)) * rng.uniform(8e-3, 15e-3, len(bad))
    found = align_by_pulses(own, base)
    assert off(found, own, offset, drift) <= 2e-5
    assert found.dropped >= len(set(bad))
    assert found.warnings == ()


@pytest.mark.slow
@FEW
@given(
    times=st.lists(st.floats(-1e5, 1e5), min_size=2, max_size=30),
    offset=offsets,
    drift=drifts,
    seed=seeds,
    bent=st.booleans(),
)
def test_order_is_kept_and_the_inverse_takes_it_back(times, offset, drift, seed, bent) -> None:
    rng = np.random.default_rng(seed)
    own = irregular(rng, 40)
    wander = (4e-3 if bent else 0.0) * np.sin(own / 20)
    found = align_by_pulses(own, offset + (1 + drift) * own + wander)
    assert found.uniform != bent
    there = found.to_base(np.sort(times))
    assert (np.diff(there) >= 0).all()
    back = found.inverse().to_base(there)
    assert found.inverse().offset_s == pytest.approx(-found.offset_s / (1 + found.drift))
    inside = np.abs(np.sort(times)) <= 1e3
    assert np.abs(back - np.sort(times)).max() < 1e-7
    assert np.abs(back - np.sort(times))[inside].max(initial=0.0) < 1e-8
    assert found.rate(16_000.0) == pytest.approx(16_000.0 / (1 + found.drift))


@pytest.mark.slow
@FEW
@given(seed=seeds, drift=drifts, epoch=st.sampled_from([0.0, 1.4e9]))
def test_whole_seconds_of_gnss_time(seed, drift, epoch) -> None:
    rng = np.random.default_rng(seed)
    offset = epoch + 37.3
    trains = Trains(rng, epoch + np.arange(50.0, 1500.0), offset, drift, 1e-6)
    near = offset + drift * trains.own[0] + rng.uniform(-0.35, 0.35)
    found = align_by_pps(trains.own, near)
    assert off(found, trains.true_own, offset, drift) <= 3e-6
    assert found.warnings == ()


def test_pulses_that_are_no_seconds_are_refused() -> None:
    with pytest.raises(InputError, match="only 20 are whole seconds apart"):
        align_by_pps(0.2 * np.arange(100.0), 0.0)
    with pytest.raises(InputError, match="lies between them"):
        align_by_pps(np.arange(100.0), 0.47)


@pytest.mark.parametrize(
    ("own", "base", "said"),
    [
        ([], [1.0], "this clock has no pulses"),
        ([1.0], [], "the base clock has no pulses"),
        ([1.0, 3.0, 2.0], [1.0, 2.0], "of this clock are not at increasing times"),
        ([1.0, np.nan], [1.0, 2.0], "of this clock are not at increasing times"),
        ([0.0, 3.0], [0.0, 5.0], "no pattern of intervals is the same in both"),
    ],
)
def test_what_cannot_be_aligned_is_refused(own, base, said) -> None:
    with pytest.raises(InputError, match=said):
        align_by_pulses(np.array(own), np.array(base))


@settings(deadline=None, max_examples=30)
@given(seed=seeds)
def test_strangers_are_refused(seed) -> None:
    rng = np.random.default_rng(seed)
    with pytest.raises(InputError, match=r"do not match|lies between"):
        align_by_pulses(irregular(rng, 60), irregular(rng, 60))


def test_one_pulse_is_an_offset_and_two_are_a_line() -> None:
    one = align_by_pulses(np.array([7.0]), np.array([10.5]))
    assert (one.offset_s, one.drift, one.pairs) == (3.5, 0.0, 1)
    assert "1 common pulse(s)" in one.warnings[0]
    two = align_by_pulses(np.array([0.0, 1000.0]), np.array([5.0, 1005.1]))
    assert two.drift == pytest.approx(1e-4)
    assert np.isnan(two.drift_sigma)
