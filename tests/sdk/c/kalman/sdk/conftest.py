"""The Kalman stages of the SDK: their filter as Python runs it, and what they make of a drive."""

import sys
from dataclasses import dataclass

import numpy as np
import pytest

from floatref.estimators import kalman
from floatref.estimators.smoothing.nodes import CORRECTION
from floatref.estimators.smoothing.segment import interpolate
from floatref.values.arrays import new_record
from floatref.values.block import join_blocks
from floatref.values.channels import ChannelId

COUNT_M = 2.0**-10


@dataclass(eq=False)
class Kernel:
    """The forward kernel as Python runs it; keeps the last state."""

    plain: object
    state: object = None

    def run(self, model, inputs, schedule, state, out):
        rows, updates = (each.view(np.recarray) for each in (out.nodes, out.updates))
        out = out._replace(nodes=rows, updates=updates)
        self.state = state
        return self.plain.run(model, inputs, schedule, state, out)

    def __getattr__(self, name):
        return getattr(self.plain, name)


@pytest.fixture
def plain_forward(plain, monkeypatch):
    """Let the Kalman stages of the SDK run their forward pass without numba."""
    kernel = Kernel(plain("estimators.kalman.forward"))
    monkeypatch.setattr(kalman, "forward", kernel, raising=False)
    monkeypatch.setitem(sys.modules, "floatref.estimators.kalman.forward", kernel)
    return kernel


def filter_by_sdk(drive, plan, noise):
    """Return the heights of the filter."""
    stage = kalman.KalmanFilter(plan, noise)
    stage.start(drive.header)
    return np.concatenate([stage.forward(block)["left"].height for block in drive.blocks()])


@pytest.fixture(scope="session")
def by_sdk():
    return filter_by_sdk


def smooth_by_sdk(drive, plan, noise):
    """Return the elevation and its 1-sigma, smoothed from the whole run, of every sample."""
    stage = kalman.KalmanSmoother(plan, noise, waiting_s=1e9)
    stage.start(drive.header)
    out = [stage.push(block) for block in drive.blocks()]
    found = join_blocks([block for block in (*out, *stage.finish()) if len(block)])
    sigma = found[ChannelId("elevation_sigma", "left")]
    return found[ChannelId("floating_reference_height", "left")] - drive.height, sigma


@pytest.fixture(scope="session")
def smoothed_by_sdk():
    return smooth_by_sdk


def elevate_by_sdk(drive, plan, noise):
    """Return the elevation alone: one backward pass of the SDK over all nodes of the run."""
    stage = kalman.KalmanSmoother(plan, noise)
    stage.start(drive.header)
    found = [stage.forward(block)["left"] for block in drive.blocks()]
    last, beyond = stage.ending()["left"]
    nodes = last.concatenate([*(each.nodes for each in found), last])
    adjoint = np.zeros(nodes.states) if beyond is None else beyond
    corrections = nodes.back(0, 1 / drive.rate, adjoint)
    height, start = np.concatenate([each.height for each in found]), new_record(CORRECTION)
    interpolate(0, start, nodes.at, corrections, 0, 1 / drive.rate, height)
    return height - drive.height


@pytest.fixture(scope="session")
def elevation_by_sdk():
    return elevate_by_sdk


def points_of(drive, interval_m):
    """Return the sample that reaches each point first, and the part of the step to it."""
    gone = np.maximum.accumulate(drive.counts - drive.counts[0]) * COUNT_M
    place = np.arange(int(gone[-1] / interval_m) + 1) * interval_m
    at = np.searchsorted(gone, place)
    before = np.maximum(at - 1, 0)
    step = gone[at] - gone[before]
    between = (step > interval_m) & (place < gone[at])
    return at, np.where(between, (place - gone[before]) / np.where(between, step, 1.0), 1.0)


def at_points(values, points):
    """Return samples read at points."""
    at, part = points
    before = values[np.maximum(at - 1, 0)]
    return np.where(part < 1.0, before + part * (values[at] - before), values[at])


@pytest.fixture(scope="session")
def read_at_points():
    return lambda values, drive, interval_m: at_points(values, points_of(drive, interval_m))
