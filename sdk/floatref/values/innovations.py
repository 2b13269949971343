"""Normalized innovations of a run: running sums, and a thinned sample for pictures.

The innovation ν of a reading is what it differs by from its prediction; S is the variance that the
filter expects of it. z = ν/√S is the normalized innovation, and z² = ν²/S the NIS of one degree of
freedom (Bar-Shalom, Li and Kirubarajan 2001, 5.4.2). Where sensors and vehicle are as the filter
takes them, all z are independent and standard normal.
"""

from dataclasses import dataclass, field

import numpy as np

from floatref.values.arrays import FloatArray, IndexArray

ROOM = 4096
"""Most innovations in a sample."""
FARTHEST, BIN = 12.0, 0.25
"""The histogram reaches so far to both sides of zero, in bins of this width."""
EDGES = np.arange(-FARTHEST, FARTHEST + BIN / 2, BIN)
"""Edges of the bins, shape (97,); the first and the last bin also hold what lies beyond."""
NEAR = 2.0
"""Number of sigma within which the `share_near` of innovations lies: 95.45 % of normal ones."""


@dataclass(eq=False)
class Innovations:
    """Those of one kind of reading of a wheel path. Nothing depends on how a run was split.

    Attributes:
        count: how many there were, each of one degree of freedom.
        total: sum of z.
        squares: sum of z².
        near: how many were within `NEAR` sigma.
        left_out: readings that the filter did not believe; they are in no other number.
        bins: how many fell into each bin of `EDGES`, shape (96,).
        every: one in `every` innovations is in the sample, the first among them.
        times_s: times of the sample since the first of the recording, shape (n,).
        sample: z of the sample, shape (n,).
    """

    count: int = 0
    total: float = 0.0
    squares: float = 0.0
    near: int = 0
    left_out: int = 0
    bins: IndexArray = field(default_factory=lambda: np.zeros(EDGES.size - 1, np.int64))
    every: int = 1
    times_s: FloatArray = field(default_factory=lambda: np.empty(0))
    sample: FloatArray = field(default_factory=lambda: np.empty(0))

    def add(self, times_s: FloatArray, z: FloatArray) -> None:
        """Take the next ``z`` at their times, shape (n,) both."""
        if z.size == 0:
            return
        chosen = slice(-self.count % self.every, None, self.every)
        self.times_s = np.concatenate((self.times_s, times_s[chosen]))
        self.sample = np.concatenate((self.sample, z[chosen]))
        while self.sample.size > ROOM:
            self.every *= 2
            self.times_s, self.sample = self.times_s[::2].copy(), self.sample[::2].copy()
        self.count += z.size
        # A cumulative sum adds one after the other, so that no split changes the rounding.
        self.total = float(np.cumsum(np.append(self.total, z))[-1])
        self.squares = float(np.cumsum(np.append(self.squares, z * z))[-1])
        self.near += int(np.count_nonzero(np.abs(z) <= NEAR))
        places = ((np.clip(z, -FARTHEST, FARTHEST) + FARTHEST) / BIN).astype(np.int64)
        self.bins += np.bincount(np.minimum(places, self.bins.size - 1), minlength=self.bins.size)

    @property
    def mean(self) -> float:
        """Mean of z; NaN without any."""
        return self.total / self.count if self.count else np.nan

    @property
    def mean_nis(self) -> float:
        """Mean of z², the NIS per degree of freedom; NaN without any."""
        return self.squares / self.count if self.count else np.nan

    @property
    def share_near(self) -> float:
        """Share of |z| up to `NEAR`, 0 to 1; NaN without any."""
        return self.near / self.count if self.count else np.nan
