"""What spoils a profile changes its shape, its places or its flags as it says."""

import numpy as np
import pytest

from floatref.measures import iri
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording
from floatref_conformance.mutants import profiles as p

INTERVAL, LENGTH = 0.05, 300.0
X = INTERVAL * np.arange(round(LENGTH / INTERVAL) + 1)
LEFT = 0.01 * np.sin(X / 3.0)
RIGHT = 0.02 * np.cos(X / 5.0)
TIMES = np.arange(30000) / 1000.0
HEIGHT = 0.28 + 0.04 * np.sin(4.0 * TIMES)
INSIDE = slice(200, -200)


@pytest.fixture
def profile():
    inner = np.abs(X - LENGTH / 2) < 100.0
    tracks = (ProfileTrack.of("left", LEFT, inner), ProfileTrack.of("right", RIGHT, inner))
    return Profile(INTERVAL, tracks)


@pytest.fixture
def recording():
    """A brake from 20 to 4 m/s until 137.5 m, and on at 10 m/s."""
    speed = np.interp(TIMES, [0.0, 5.0, 8.125, 12.0, 30.0], [20.0, 20.0, 4.0, 10.0, 10.0])
    clock = UniformClock.of(1000.0)
    distance = np.append(0.0, np.cumsum(speed[1:] / 1000.0))
    return Recording(
        (Channel.of("distance", distance, clock), Channel.of("height", HEIGHT, clock, "left"))
    )


def left(found):
    return found.track("left").elevation


CHANGES = {
    "scaled": (p.scale(0.8), 0.8 * LEFT),
    "moved": (p.move(0.3), 0.01 * np.sin((X - 0.3) / 3.0)),
    "stretched": (p.stretch(0.01), 0.01 * np.sin(X / 1.01 / 3.0)),
    "averaged": (p.average(1.0), LEFT * np.sin(1.05 / 6.0) / (1.05 / 6.0)),
    "both": (p.chain(p.scale(2.0), p.move(0.3)), 0.02 * np.sin((X - 0.3) / 3.0)),
}


@pytest.mark.parametrize("name", CHANGES)
def test_the_shape_changes_as_said_and_the_flags_stay(name, profile, recording):
    spoil, expected = CHANGES[name]
    found = spoil(profile, recording)
    assert np.allclose(left(found)[INSIDE], expected[INSIDE], atol=2e-6)
    assert np.array_equal(found.track("left").valid, profile.track("left").valid)


def test_steps_and_whole_multiples(profile, recording):
    steps = left(p.hold_in_steps(0.5)(profile, recording))
    assert np.array_equal(steps, np.repeat(LEFT[::10], 10)[: LEFT.size])
    coarse = left(p.round_to(0.001)(profile, recording))
    assert np.allclose(coarse * 1000, np.round(coarse * 1000))
    assert np.abs(coarse - LEFT).max() <= 0.0005 + 1e-12


def test_the_order_of_points_and_tracks(profile, recording):
    assert np.array_equal(left(p.reverse(profile, recording)), LEFT[::-1])
    assert np.array_equal(left(p.swap_tracks(profile, recording)), RIGHT)
    alike = p.average_tracks(profile, recording)
    assert np.allclose(left(alike), (LEFT + RIGHT) / 2)
    assert np.array_equal(left(alike), alike.track("right").elevation)


def test_what_is_left_out(profile, recording):
    ended = left(p.drop_end(30.0)(profile, recording))
    assert np.isnan(ended).sum() == pytest.approx(30.0 / INTERVAL, abs=1)
    assert np.isnan(ended[-1])
    late = p.drop_start(5.0)(profile, recording)
    assert late.start_m == pytest.approx(5.0)
    assert np.array_equal(left(late), LEFT[100:])


def test_flags_are_set_and_taken(profile, recording):
    assert p.mark_valid(profile, recording).track("left").valid.all()
    assert not p.flag_all(profile, recording).track("left").valid.any()
    around = p.flag_around(lambda drive: 150.0, 40.0)(profile, recording).track("left").valid
    assert INTERVAL * (profile.track("left").valid & ~around).sum() == pytest.approx(40.0, abs=0.1)


def test_noise_and_motion_come_into_a_flat_profile_alone(profile, recording):
    flat = Profile(INTERVAL, (ProfileTrack.of("left", 0.0 * X),))
    assert np.array_equal(left(p.add_noise_where_flat(1e-4)(profile, recording)), LEFT)
    rough = [iri(left(p.add_noise_where_flat(s)(flat, recording)), INTERVAL) for s in (1e-4, 2e-4)]
    assert rough[0] > 0.0
    assert rough[1] == pytest.approx(2.0 * rough[0], rel=1e-6)
    moved = left(p.add_motion_where_flat(0.01)(flat, recording))
    assert np.ptp(moved) == pytest.approx(0.01 * np.ptp(HEIGHT), rel=0.02)
    both = Profile(INTERVAL, profile.tracks[:1])
    assert np.array_equal(left(p.add_motion_where_flat(0.01)(both, recording)), LEFT)


def test_what_is_slowest_is_where_it_is_held_drawn_straight_or_lost(profile, recording):
    near, behind = np.abs(X - 137.5) < 18.0, (X > 140.0) & (X < 290.0)
    held = p.hold_at_slowest(20.0)(profile, recording).track("left")
    assert np.ptp(held.elevation[near]) == 0.0
    assert held.valid.all()
    line = left(p.straighten_at_slowest(20.0)(profile, recording))
    assert np.allclose(np.diff(line[near], 2), 0.0, atol=1e-12)
    lost = left(p.lose_at_slowest(0.3)(profile, recording))
    assert np.array_equal(lost[X < 135.0], LEFT[X < 135.0])
    assert np.allclose(lost[behind], np.interp(X + 0.3, X, LEFT)[behind])


def test_the_profile_before_is_delivered(profile, recording):
    spoil = p.Previous()
    other = p.scale(2.0)(profile, recording)
    assert spoil(profile, recording) is profile
    assert spoil(other, recording) is profile
    assert spoil(profile, recording) is other
