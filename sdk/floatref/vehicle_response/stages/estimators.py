"""The estimators of the road with one interface: readings in, road and states out."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId
from floatref.vehicle_response import VehicleModel
from floatref.vehicle_response.estimators.estimate import Estimate


class RoadEstimator(Protocol):
    """Takes samples of its readings, shape (N, m), in their order; NaN is missing."""

    def begin(self) -> Any:
        """Return the memory of a run, which can be copied."""

    def advance(self, memory: Any, samples: FloatArray) -> Estimate:
        """Return the estimate for the next samples, and change ``memory``."""


class DisplacementObserver(Protocol):
    """Takes displacements y, shape (N, k), and accelerations z'' of p wheels, shape (N, p)."""

    def begin(self) -> Any:
        """Return the memory of a run, which can be copied."""

    def advance(self, memory: Any, y: FloatArray, z: FloatArray, /) -> Estimate:
        """Return the estimate for the next samples, and change ``memory``."""


@dataclass(frozen=True, eq=False)
class WithPlaces:
    """An observer that takes its inputs apart, (8) of Imine, from among the readings.

    Attributes:
        observer: that takes displacements y and accelerations z'' of the wheels.
        displacements: places of y in the samples.
        accelerations: places of z'', one for each tyre.
    """

    observer: DisplacementObserver
    displacements: tuple[int, ...]
    accelerations: tuple[int, ...]

    def begin(self) -> Any:
        """Return the memory of a run."""
        return self.observer.begin()

    def advance(self, memory: Any, samples: FloatArray) -> Estimate:
        """Return the estimate for the next samples, shape (N, m), and change ``memory``."""
        y, a = samples[:, list(self.displacements)], samples[:, list(self.accelerations)]
        return self.observer.advance(memory, y, a)


@dataclass(frozen=True, eq=False)
class Group:
    """One model under an estimator: its inputs, and the wheel paths of its tyres.

    Attributes:
        model: the vehicle.
        inputs: channel and sign of each reading, in the order of the estimator's.
        tracks: wheel path of each tyre.
        densities: of the accelerometer that the height of each tyre's wheel is integrated from, in
            m/s²/√Hz; 0 where that height is measured.
    """

    model: VehicleModel
    estimator: RoadEstimator
    inputs: tuple[tuple[ChannelId, float], ...]
    tracks: tuple[str, ...]
    densities: tuple[float, ...]

    @property
    def channels(self) -> tuple[ChannelId, ...]:
        """The channels of its readings."""
        return tuple(channel for channel, _ in self.inputs)

    @property
    def numbers(self) -> tuple[int, ...]:
        """Number of each tyre among those of its wheel path."""
        return tuple(self.tracks[:k].count(track) for k, track in enumerate(self.tracks))

    @property
    def wheels(self) -> tuple[int, ...]:
        """Place of each tyre's wheel among the coordinates."""
        return tuple(self.model.index(tyre.freedom) for tyre in self.model.tyres)

    def samples(self, values: Sequence[FloatArray]) -> FloatArray:
        """Return the readings, shape (N, m), of the channels' samples in the same order."""
        signed = (sign * x for (_, sign), x in zip(self.inputs, values, strict=True))
        return np.stack(list(signed), axis=1)
