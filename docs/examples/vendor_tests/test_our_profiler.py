"""A vendor's own test suite: laws of a stage, and checks of a device."""

import numpy as np

from floatref import Block, ChannelId, Declared, Header, Stage
from floatref_conformance.testing import DeviceChecks, StageLaws

HEIGHT = "height"


class LagHeight(Stage):
    """Delays the height by a fixed number of samples; before the first there is zero."""

    declared = Declared()

    def __init__(self, samples: int) -> None:
        """Delay by ``samples``, one or more."""
        super().__init__()
        self.samples = samples

    def open(self, header: Header) -> Header:
        """Ask for the height of every track and begin with zeros."""
        self.channels = [ChannelId(HEIGHT, track) for track in header.tracks]
        header.require(self.name, *self.channels)
        self.memory = {str(c): np.zeros(self.samples) for c in self.channels}
        self.memory |= {f"flags {c}": np.zeros(self.samples, np.uint8) for c in self.channels}
        return header

    def advance(self, block: Block) -> Block:
        """Return the block with the heights, and their flags, that came before."""
        clean = np.zeros(len(block), np.uint8)
        values = {c: self._late(str(c), block[c]) for c in self.channels}
        flags = {c: self._late(f"flags {c}", block.flags.get(c, clean)) for c in self.channels}
        return block.setting(values, flags)

    def _late(self, name: str, new: np.ndarray) -> np.ndarray:
        wide = np.concatenate((self.memory[name], new))
        self.memory[name] = wide[new.size :].copy()
        return wide[: new.size]


class TestLagHeight(StageLaws):
    """All laws of the stage protocol."""

    reads = (HEIGHT,)

    def make(self) -> LagHeight:
        """Return the stage as our engine uses it."""
        return LagHeight(samples=3)


class TestOurProfiler(DeviceChecks):
    """Two checks of the conformance suite; leave `checks` out for all of them."""

    device = "builtin:temporal-adaptive-hpf-spatial-backward"
    checks = ("quiescent", "bounce")
