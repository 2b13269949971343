"""Provisional points: there in time, one behind another, and like the final ones in short waves."""

import numpy as np
import pytest

from floatref import start_stream
from floatref.live.as_live import clocks_of
from floatref.live.bounds import TICK_S
from floatref.live.declared_channels import Piece
from floatref.live.forward_pass import forward_pass_of
from floatref.live.held_samples import HeldChannel
from floatref.live.points import State
from floatref.measures import iri
from floatref.values.recording import Channel

INTERVAL_M = 0.1


@pytest.fixture(scope="module")
def recording(drive):
    return drive([(20.0, 130.0), (0.0, 20.0), (20.0, 60.0)], tracks=("left", "right"))


def streamed(recording, pieces, seed=1, **how):
    """Yield the time of the newest sample, and the points that are there then."""
    clocks = clocks_of(recording)
    with start_stream(recording.setup, clocks, "temporal-matched-hpf") as stream:
        pushed = dict.fromkeys(clocks, 0)
        for piece in pieces(recording, seed, **how):
            stream.push(piece)
            for channel in recording.channels:
                own = piece.get(str(channel.id), ())
                pushed[channel.id] += len(own)
            ends = [c.clock.times(1, pushed[c.id] - 1)[0] for c in recording.channels]
            yield min(ends), stream.ready(wait=True)
        yield np.inf, stream.finish()


def joined(points, state):
    """Return numbers, elevation and validity of the points of the first wheel path."""
    own = [p for p in points if p.state is state]
    numbers = np.concatenate([p.first + np.arange(len(p)) for p in own])
    tracks = [p.tracks[0] for p in own]
    elevation, valid = ([getattr(t, name) for t in tracks] for name in ("elevation", "valid"))
    return numbers, np.concatenate(elevation), np.concatenate(valid)


@pytest.mark.slow
def test_every_provisional_point_is_there_a_tick_after_its_samples(recording, pieces):
    distance = recording.channel("distance")
    for newest_s, points in streamed(recording, pieces, most_s=1.0):
        own = [p for p in points if p.state is State.PROVISIONAL]
        if np.isfinite(newest_s) and own:
            reached_m = np.interp(newest_s - TICK_S, distance.times_s, distance.values)
            assert own[-1].distance_m[-1] > reached_m - INTERVAL_M


@pytest.mark.slow
def test_each_is_replaced_by_its_final_point(recording, pieces):
    points = [p for _, found in streamed(recording, pieces) for p in found]
    numbers, elevation, valid = joined(points, State.PROVISIONAL)
    final_numbers, final_elevation, final_valid = joined(points, State.FINAL)
    assert (np.diff(numbers) == 1).all()
    assert set(numbers) <= set(final_numbers)
    assert numbers.size >= final_numbers.size - 25 / INTERVAL_M
    where = numbers - final_numbers[0]
    both = valid & final_valid[where]
    assert both.mean() > 0.7
    # A forward pass has the roughness of the road, if not its long waves.
    rough = iri(elevation[both], INTERVAL_M)
    assert rough == pytest.approx(iri(final_elevation[where][both], INTERVAL_M), rel=0.05)
    assert all(p.tracks[0].sigma is None for p in points if p.state is State.PROVISIONAL)


@pytest.mark.slow
def test_no_point_is_valid_near_a_stop(recording, pieces):
    points = [p for _, found in streamed(recording, pieces) for p in found]
    numbers, _, valid = joined(points, State.PROVISIONAL)
    stop_m = 20.0 * 130.0 + 20.0**2 / 2.0 / 1.5
    near = np.abs(numbers * INTERVAL_M - stop_m - 50.0) < 55.0
    assert not valid[near].any()


@pytest.mark.slow
def test_they_do_not_depend_on_the_pieces(recording, pieces):
    one, two = (
        [p for _, found in streamed(recording, pieces, seed=seed) for p in found] for seed in (3, 4)
    )
    for a, b in zip(joined(one, State.PROVISIONAL), joined(two, State.PROVISIONAL), strict=True):
        np.testing.assert_array_equal(a, b)


MISSING_S = 40.0, 47.0


@pytest.mark.parametrize("name", ["distance", "left.height", "right.vertical_specific_force"])
def test_behind_a_missing_channel_it_begins_anew(recording, name):
    """Points behind the gap are those of a pass that has seen nothing before it."""
    channels = [_without(c, MISSING_S) if str(c.id) == name else c for c in recording.channels]
    found = list(_passed(recording, channels, 0.0))
    behind = list(_passed(recording, channels, MISSING_S[1] - 5.0))
    assert behind[0].first * INTERVAL_M > 20.0 * MISSING_S[1] - 25.0
    numbers, elevation, valid = joined(found, State.PROVISIONAL)
    own_numbers, own_elevation, own_valid = joined(behind, State.PROVISIONAL)
    where = numbers >= own_numbers[0]
    np.testing.assert_array_equal(numbers[where], own_numbers)
    np.testing.assert_array_equal(elevation[where], own_elevation)
    np.testing.assert_array_equal(valid[where], own_valid)
    # The last sample is held for a second.
    gap_m = 20.0 * np.array(MISSING_S) + np.array([25.0, -11.0])
    assert not ((numbers * INTERVAL_M > gap_m[0]) & (numbers * INTERVAL_M < gap_m[1])).any()
    # It runs in over a wavelength, and has the speed of the vehicle then.
    assert not valid[
        (numbers * INTERVAL_M > gap_m[0]) & (numbers * INTERVAL_M < gap_m[1] + 100)
    ].any()
    assert valid[(numbers * INTERVAL_M > gap_m[1] + 140) & (numbers * INTERVAL_M < 2400)].all()


def _without(channel, span_s):
    values, times = np.array(channel.values), channel.times_s
    values[(times > span_s[0]) & (times < span_s[1])] = np.nan
    return Channel(channel.id, values, channel.clock)


def _passed(recording, channels, begin_s):
    """Yield the points of a forward pass that is asked for them from ``begin_s`` on."""
    held = {c.id: HeldChannel(c.id, c.clock) for c in channels}
    for each in channels:
        held[each.id].add(Piece(each.values))
    clock = recording.channel("vertical_specific_force", "left").clock
    forward = forward_pass_of(recording, ("left", "right"), clock, INTERVAL_M)
    for tick in range(round(begin_s / TICK_S), round(130.0 / TICK_S)):
        points = forward.advance(held, tick * TICK_S, (tick + 1) * TICK_S, 0.0)
        if points is not None:
            yield points
