"""The stage that levels is the literal one, keeps the laws of stages, and says what it lacks."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.estimators.kalman.inputs import IMU
from floatref.estimators.levelling import Level
from floatref.estimators.levelling.attitude import BIN_S, NEAR_S, PATIENCE_S
from floatref.values.arrays import Flag
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId
from floatref_conformance.testing import StageLaws
from floatref_reference.road_prior.levelling import Smoothing, Unit, level

laws = settings(deadline=None, max_examples=6)
SEEDS = st.integers(0, 2**32 - 1)
X, Y, ROLL, PITCH, YAW = (ChannelId(name) for name in IMU)
Z, DISTANCE = ChannelId("vertical_specific_force", "left"), ChannelId("distance")
UP = ChannelId("vertical_acceleration", "left")
FAR_S = 1.5


def drawn(seed, rate, seconds, holes=True):
    """Return samples that agree with no drive, with holes in all of them."""
    rng, n = np.random.default_rng(seed), round(rate * seconds)
    values = {c: rng.normal(size=n) for c in (X, Y)}
    values[Z] = 9.8 + rng.normal(size=n)
    values.update({c: 0.1 * rng.normal(size=n) for c in (ROLL, PITCH, YAW)})
    values[DISTANCE] = np.cumsum(np.abs(rng.normal(size=n))) / rate
    for channel in values if holes else ():
        begin = rng.integers(0, n)
        values[channel][begin : begin + rng.integers(1, n // 4 + 2)] = np.nan
    return values


def run(values, rate, cuts=(), flags=None):
    stage, n = Level(FAR_S), values[Z].size
    channels = frozenset(values)
    stage.start(Header(Axis.TIME, 1 / rate, 0.0, Fraction(rate), channels, ("left",)))
    out = []
    for i, j in pairwise([0, *sorted(set(cuts)), n]):
        marks = {c: f[i:j] for c, f in (flags or {}).items()}
        out.append(stage.push(Block(i, {c: v[i:j].copy() for c, v in values.items()}, {}, marks)))
    return join_blocks([block for block in (*out, *stage.finish()) if len(block)])


def literal(values, rate):
    every = max(1, round(BIN_S * rate))
    how = Smoothing(every, NEAR_S, FAR_S, max(1, round(PATIENCE_S * rate / every)))
    force, rates = ([values[c] for c in names] for names in ((X, Y, Z), (ROLL, PITCH, YAW)))
    return level(Unit(np.array(force), np.array(rates), values[DISTANCE], 1 / rate), how)


@pytest.mark.slow
@pytest.mark.cites("(2.20)", "(6.27)", "(6.28)")
@laws
@given(seed=SEEDS, rate=st.sampled_from([10, 20, 50, 90]), seconds=st.sampled_from([0.5, 3, 9]))
def test_it_is_the_literal_one(seed, rate, seconds):
    values = drawn(seed, rate, seconds)
    found = run(values, rate)[UP]
    np.testing.assert_allclose(found, literal(values, rate), rtol=0, atol=1e-9)


@pytest.mark.slow
@laws
@given(
    seed=SEEDS,
    cuts=st.lists(st.integers(1, 1499), max_size=8, unique=True),
    every=st.sampled_from([1, 7, 300, 1300]),
)
def test_any_split_gives_the_same_bits(seed, cuts, every):
    values = drawn(seed, 100, 15)
    whole = run(values, 100)
    for pieces in (cuts, range(every, 1500, every)):
        found = run(values, 100, pieces)
        np.testing.assert_array_equal(found[UP], whole[UP])
        np.testing.assert_array_equal(found.flags[UP], whole.flags[UP])


@pytest.mark.slow
def test_blocks_come_out_before_the_run_ends_and_little_is_kept():
    rate = 100
    values, stage = drawn(3, rate, 120, holes=False), Level(FAR_S)
    channels = frozenset(values)
    stage.start(Header(Axis.TIME, 1 / rate, 0.0, Fraction(rate), channels, ("left",)))
    held = 0
    for i in range(0, 120 * rate, 50):
        block = Block(i, {c: v[i : i + 50].copy() for c, v in values.items()})
        held += len(block) - len(stage.push(block))
        assert held <= (4 * (NEAR_S + FAR_S) + 2.0) * rate
    (attitude,) = stage.memory["attitudes"].values()
    kept = (attitude.by_gravity, attitude.tilts, attitude.swung, attitude.more, attitude.near.held)
    assert max(each.values.shape[1] for each in kept) <= 2 * 4 * FAR_S / BIN_S


@laws
@given(seed=SEEDS)
def test_what_a_long_gap_hides_is_flagged_as_drift(seed):
    """Behind a second without rates they begin anew; a gap that is bridged is flagged only there.

    The angle at the end of the gap is another than the rates across it say.
    """
    rate, n = 100, 3000
    values = drawn(seed, rate, 30, holes=False)
    for channel in (X, Y, ROLL, PITCH, YAW):
        values[channel][:] = 0.0
    values[Z][:] = 9.80665
    values[DISTANCE] = 10.0 * np.arange(n) / rate
    theta = np.where(np.arange(n) < 1450, 0.0, 0.05)
    values[X] = -9.80665 * np.sin(theta)
    values[Z] = 9.80665 * np.cos(theta)
    marks = np.zeros(n, np.uint8)
    marks[1400:1500] = Flag.MISSING
    out = run(values, rate, flags={PITCH: marks})
    flags = out.flags[UP]
    assert (flags[1420:1480] & Flag.DRIFT).all()
    assert ((flags != 0) == (marks != 0)).all() or (flags[:1400] == 0).all()
    known = flags & Flag.DRIFT == 0
    known[1390:1510] = False
    assert np.abs(out[UP][known]).max() < 1e-6


@pytest.mark.parametrize("missing", [*IMU, "vertical_specific_force", "distance"])
def test_a_channel_that_is_not_there_is_named(missing):
    channels = frozenset(drawn(0, 100, 1))
    header = Header(Axis.TIME, 0.01, 0.0, Fraction(100), channels, ("left",)).without(missing)
    with pytest.raises(
        InputError, match=f"needs channel (left.)?{missing}; add a stage that makes it"
    ):
        Level().start(header)


def test_it_works_in_time_alone():
    channels = frozenset(drawn(0, 100, 1))
    header = Header(Axis.TIME, 0.01, 0.0, Fraction(100), channels, ("left",))
    with pytest.raises(InputError, match="the stream is not on the time axis"):
        Level().start(header.on_distance(0.05, 0.0))


class TestLevel(StageLaws):
    """Two wheel paths with horizontal forces of their own; samples that agree with no drive."""

    reads = (
        "vertical_specific_force",
        "longitudinal_specific_force",
        "lateral_specific_force",
    )
    shared = ("roll_rate", "pitch_rate", "yaw_rate", "distance")
    reach = None

    def make(self):
        return Level(0.2)
