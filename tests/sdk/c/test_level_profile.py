"""The profile of samples that C has levelled is that of samples that the SDK has."""

import numpy as np
import pytest
from tests.sdk.c.level_runs import COUNT_M, FORCE, HEIGHT, RATE, TRACKS, level, made_of, run_of
from tests.sdk.c.level_stops import Stop

from floatref import AxleSetup, Setup, TrackSetup, process
from floatref.estimators.laser_place.by_model import RAISED
from floatref.estimators.road_slope.stage import ADDED, LevelByRoad
from floatref.stages.signals import LEVELLING_SIGMA
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording

SMALL = 0.1
"""Of the largest 1-σ in m that levelling leaves in the elevation of a run: there the profile is not
known any better."""


def recording_of(run, stop):
    """Return a recording of both wheel paths, with lasers ahead of their accelerometers."""
    clock, lever = UniformClock.of(RATE), (stop.lever_m, 0.0, 0.0)
    place = TrackSetup((10.0 - stop.front_m - stop.lever_m, 0.0, 0.0), lever)
    signals = ((FORCE, run.force), (HEIGHT, run.height))
    channels = [
        Channel.of(name, x[:, k].copy(), clock, track)
        for name, x in signals
        for k, track in enumerate(TRACKS)
    ]
    channels.append(Channel.of("distance", run.counts * COUNT_M, clock))
    axles = AxleSetup(stop.wheelbase_m, 10.0)
    setup = Setup(tracks=dict.fromkeys(TRACKS, place), axles=axles, profile_interval_m=0.05)
    return Recording(tuple(channels), setup)


@pytest.mark.parametrize(
    "stop", [Stop(stops=2, between_s=20.0), Stop(lever_m=0.3)], ids=["two stops", "a lever"]
)
def test_what_is_added_makes_the_profile_of_the_sdk(double, stop, monkeypatch):
    run = run_of(stop)
    found, recording = level(made_of(double, stop), run), recording_of(run, stop)
    expected = process(recording, pipeline="road-prior-smoother")
    by_sdk, sigmas = LevelByRoad.find_pitch, []

    def find_pitch(self, bins):
        known = by_sdk(self, bins)
        sigmas.append(known[LEVELLING_SIGMA].max())
        places, at = np.arange(known[RAISED].size), found["first"] / (RATE / 100.0)
        ours = {ADDED: found["added"], RAISED: found["sin_pitch"]}
        return known | {name: np.interp(places, at, values) for name, values in ours.items()}

    monkeypatch.setattr(LevelByRoad, "find_pitch", find_pitch)
    ours = process(recording, pipeline="road-prior-smoother")
    assert len(sigmas) == 1
    for track in TRACKS:
        off = ours.track(track).elevation - expected.track(track).elevation
        assert np.nanmax(np.abs(off)) <= SMALL * sigmas[0]
