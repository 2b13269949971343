"""What `bench_kalman.py` and `bench_road_prior.py` give the stages and their peers to do."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any
from unittest import mock

import numpy as np

import floatref
from floatref.estimators.kalman import KalmanSmoother, Noise, Plan, forward
from floatref.estimators.kalman.inputs import IMU
from floatref.intake.blocks import BLOCK, Source
from floatref.screening.findings import Screening
from floatref.stages.conditioning import RemoveGravity
from floatref.stages.filters.butterworth import low_pass_b3
from floatref.stages.protocol import Stage
from floatref.stages.signals import ACCELERATION, DISTANCE, HEIGHT, REFERENCE_HEIGHT, SIGMA
from floatref.stages.speed import TravelSpeed
from floatref.values.block import Block, Header
from floatref.values.channels import ChannelId

TRACK = "left"


@dataclass(frozen=True, eq=False)
class Prepared:
    header: Header
    blocks: list[Block]

    @classmethod
    def of(cls, recording: floatref.Recording, more: Sequence[str] = IMU) -> "Prepared":
        """Pass ``recording`` through what comes before the stage in its pipelines."""
        source = Source(Screening.of(recording), more)
        header, blocks = source.header, list(source.blocks(BLOCK))
        filters = low_pass_b3(ACCELERATION, 1000.0), low_pass_b3(HEIGHT, 1000.0)
        for stage in (RemoveGravity(), *filters[0], *filters[1], TravelSpeed()):
            header = stage.start(header)
            order = stage.direction.value
            blocks = [*map(stage.push, blocks[::order])][::order]
            blocks = [block for block in (*blocks, *stage.finish()) if len(block)]
        return cls(header, blocks)

    @property
    def samples(self) -> int:
        """Number of samples."""
        return sum(map(len, self.blocks))

    def smoothed(self, plan: Plan, noise: Noise, **options: float) -> list[Block]:
        return self.through(KalmanSmoother(plan, noise, **options))

    def through(self, stage: Stage) -> list[Block]:
        stage.start(self.header)
        pushed = [stage.push(block) for block in self.blocks]
        return [*pushed, *stage.finish()]

    def result(self, plan: Plan, noise: Noise) -> list[np.ndarray]:
        """Run the stage with no segment closed before the end; return height and 1-σ."""
        blocks = self.smoothed(plan, noise, tolerance_m=0.0)
        made = (ChannelId(name, TRACK) for name in (REFERENCE_HEIGHT, SIGMA))
        return [np.concatenate([block[channel] for block in blocks]) for channel in made]


class Task:
    """What the stage hands to the forward kernel, for others to do the same."""

    def __init__(self, prepared: Prepared, plan: Plan, noise: Noise) -> None:
        """Listen to a run of the stage."""
        heard: list[Any] = []
        run = forward.run

        def listening(model: Any, u: Any, observed: Any, state: Any, out: Any) -> int:
            y, variances, drifted = observed[2:]
            rows = np.hstack((y, variances, drifted[:, np.newaxis]))
            x, variance = state.x.copy(), np.diag(state.p).copy()
            heard.append((u[1:], observed.at, observed.marks, rows, model, x, variance))
            return run(model, u, observed, state, out)

        with mock.patch.object(forward, "run", listening):
            self.height, self.sigma = prepared.result(plan, noise)
        inputs, at, marks, rows = zip(*(call[:4] for call in heard), strict=True)
        model, self.x, self.variance = heard[0][4:]
        self.sub_block = model.sub_block
        constants = (value for name, value in model._asdict().items() if name != "sub_block")
        self.model = np.hstack([*constants])
        self.distance = np.concatenate([block[ChannelId(DISTANCE)] for block in prepared.blocks])
        self.u = [np.concatenate(pieces) for pieces in zip(*inputs, strict=True)]
        self.at = np.concatenate(at).astype(np.int64)
        self.marks = np.concatenate(marks).astype(np.int64)
        self.rows = np.ascontiguousarray(np.concatenate(rows))
