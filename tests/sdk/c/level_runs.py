"""Samples of a run with stops, levelled by the C library and by the SDK."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from tests.sdk.c.conftest import Made
from tests.sdk.c.level_stops import drive_of

from floatref import AxleSetup, Setup, TrackSetup
from floatref.estimators.road_slope.levelled import Levelled
from floatref.estimators.road_slope.stage import LevelByRoad, from_laser
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId

RATE, COUNT_M, WAVELENGTH_M = 200.0, 2.0**-12, 105.91
TRACKS = "left", "right"
FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", ChannelId("distance")
FIELDS = ("first", "added", "sin_pitch", "share", "sigma_m", "outcome")


class Run(NamedTuple):
    """Samples of two wheel paths, shape (n, 2), and counts of the encoder, shape (n,)."""

    force: np.ndarray
    height: np.ndarray
    counts: np.ndarray


def run_of(stop, rate=RATE):
    """Return the samples of a stop: both wheel paths read the same, with noise of their own."""
    drive = drive_of(replace(stop, step_s=1.0 / rate, unread=0.0, missing=0.0))
    rng, size = np.random.default_rng(stop.seed + 1), drive.force.size
    noise = rng.normal(size=(2, size, 2)) * [[[1e-3]], [[1e-4]]]
    force, height = drive.force[:, np.newaxis] + noise[0], drive.height[:, np.newaxis] + noise[1]
    counts = np.rint(drive.distance / COUNT_M).astype(np.int64)
    return Run(force + STANDARD_GRAVITY, height, counts)


def made_of(library, stop, rate=RATE, **settings):
    """Return an object for the vehicle of a stop."""
    axles = {"front_m": stop.front_m, "rear_m": stop.front_m - stop.wheelbase_m}
    inside = {f"fit__{name}": value for name, value in axles.items()}
    inside |= {"fit__lever_m": stop.lever_m, "rate_hz": rate, "metres_per_count": COUNT_M}
    return library.make("level", **{**inside, **settings})


def push(made, run, part):
    """Return the status of a push of a part of a run, and how many bins are ready."""
    library, ready = made.library, made.library.ffi.new("size_t *")
    arrays = [library.array(x[part]) for x in run]
    pointers = [library.at(x) for x in arrays]
    status = made.call("push", *pointers, arrays[-1].size, ready)
    return library.status[status], ready[0]


def take(made, capacity=4000):
    """Return the bins that are ready, shape (n, 6)."""
    ffi = made.library.ffi
    bins, written = ffi.new("fr_level_bin[]", capacity), ffi.new("size_t *")
    assert made.call("take", bins, capacity, written) == 0
    return [[getattr(b, name) for name in FIELDS] for b in bins[0 : written[0]]]


def finish(made):
    ready = made.library.ffi.new("size_t *")
    assert made.call("finish", ready) == 0
    found = []
    while rows := take(made):
        found += rows
    return found


def level(made, run, edges=None):
    """Return all bins of a run, by name, that is pushed in parts between ``edges``."""
    edges = range(0, len(run.counts) + 999, 1000) if edges is None else edges
    rows = []
    for begin, end in pairwise(edges):
        assert push(made, run, slice(begin, end))[0] == "FR_OK"
        rows += take(made, 40_000)
    columns = np.array(rows + finish(made)).T
    return dict(zip(FIELDS, columns, strict=True))


def copy_of(made):
    return Made(made.library, made.kind, made.memory.copy())


def level_by_sdk(run, stop, rate=RATE):
    """Return the bins of a run and what `Levelled` finds of them."""
    channels = {ChannelId(name, track) for name in (FORCE, HEIGHT) for track in TRACKS}
    laser_m = 10.0 - stop.front_m
    place = TrackSetup((laser_m - stop.lever_m, 0.0, 0.0))
    setup = Setup(tracks=dict.fromkeys(TRACKS, place), axles=AxleSetup(stop.wheelbase_m, 10.0))
    known = frozenset({*channels, DISTANCE})
    header = Header(Axis.TIME, 1 / rate, 0.0, Fraction(round(rate)), known, TRACKS, setup)
    stage = LevelByRoad(dict.fromkeys(TRACKS, stop.lever_m))
    stage.open(header)
    values = {DISTANCE: run.counts * COUNT_M}
    for name, read in ((FORCE, run.force), (HEIGHT, run.height)):
        values |= {ChannelId(name, track): read[:, k].copy() for k, track in enumerate(TRACKS)}
    stage.survey(Block(0, values))
    drive = stage._drive(stage.whole_bins())
    places = from_laser(stage.places())
    return drive, Levelled.of(drive, places, stage._model(), WAVELENGTH_M)
