"""Samples of a drive whose pitch is modelled by the C library and by the SDK."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
from tests.sdk.c.level_runs import COUNT_M, DISTANCE, FORCE, HEIGHT, RATE, TRACKS, push

from floatref import AxleSetup, Setup, TrackSetup
from floatref.estimators.laser_place import HeightByModel
from floatref.estimators.laser_place.by_model import RAISED
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId


def made_of(library, stop, rate=RATE, **settings):
    """Return an object for the vehicle of a stop."""
    places = {"front_m": stop.front_m, "rear_m": stop.front_m - stop.wheelbase_m}
    places |= {"lever_m": stop.lever_m, "rate_hz": rate, "metres_per_count": COUNT_M}
    return library.make("pitch", **{**places, **settings})


def take(made, capacity=100_000):
    """Return the sines that are ready."""
    found, written = np.full(capacity, np.nan), made.library.ffi.new("size_t *")
    into = made.library.ffi.cast("double *", found.ctypes.data)
    assert made.call("take", into, capacity, written) == 0
    return found[: written[0]]


def finish(made):
    ready = made.library.ffi.new("size_t *")
    assert made.call("finish", ready) == 0
    found = take(made)
    assert found.size == ready[0]
    return found


def model(made, run, edges=None):
    """Return the sines of all bins of a run that is pushed in parts between ``edges``."""
    edges = [*range(0, len(run.counts), 1000), len(run.counts)] if edges is None else edges
    found = []
    for begin, end in pairwise(edges):
        assert push(made, run, slice(begin, end))[0] == "FR_OK"
        found.append(take(made))
    return np.concatenate([*found, finish(made)])


def stage_of(stop, rate=RATE):
    """Return the SDK's stage for the same vehicle, its stream begun."""
    channels = {ChannelId(name, track) for name in (FORCE, HEIGHT) for track in TRACKS}
    laser_m = 10.0 - stop.front_m
    place = TrackSetup((laser_m - stop.lever_m, 0.0, 0.0))
    setup = Setup(tracks=dict.fromkeys(TRACKS, place), axles=AxleSetup(stop.wheelbase_m, 10.0))
    known = frozenset({*channels, DISTANCE})
    stage = HeightByModel(dict.fromkeys(TRACKS, stop.lever_m))
    stage.open(Header(Axis.TIME, 1 / rate, 0.0, Fraction(rate), known, TRACKS, setup))
    return stage


def model_by_sdk(run, stop, rate=RATE):
    """Return the sines by the SDK."""
    stage = stage_of(stop, rate)
    values = {DISTANCE: run.counts * COUNT_M}
    for name, read in ((FORCE, run.force), (HEIGHT, run.height)):
        values |= {ChannelId(name, track): read[:, k].copy() for k, track in enumerate(TRACKS)}
    stage.survey(Block(0, values))
    return stage.find_pitch(stage.whole_bins())[RAISED]
