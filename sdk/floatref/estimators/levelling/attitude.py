"""Pitch and roll of the body against gravity, from rates, specific forces and the encoder."""

from dataclasses import dataclass, field

import numpy as np

from floatref.estimators.levelling.lines import Held, LocalLines, Means
from floatref.values.arrays import BoolArray, FloatArray, new_record
from floatref.values.channels import STANDARD_GRAVITY

BIN_S = 0.05
"""Gravity and the rates are compared so often; the Gaussians are many times as wide."""
NEAR_S = 1.0
"""Standard deviation of the Gaussian behind the angles that turn the rates of the body into those
of the angles, (6.27) and (6.28)."""
PATIENCE_S = 0.1
"""Without rates for so long nothing is known of how the angles before and behind differ."""
NEVER = 1 << 62
ANGLES = np.dtype([(n, np.float64) for n in ("pitch", "roll", "pitching", "rolling")], align=True)
"""Pitch and roll by the rates, and the rates of both at the latest sample, NaN before any."""


def _no_angles() -> np.record:
    angles = new_record(ANGLES)
    angles.pitching = angles.rolling = np.nan
    return angles


@dataclass(eq=False)
class Attitude:
    """The attitude of one wheel path: gravity shows it slowly, the rates show it fast.

    Samples are counted from the first of the run, and come twice: to `see` as they are, and, as
    soon as they lie before `turns_before`, to `turn`, which integrates the rates. What has been
    turned can be levelled as soon as it lies before `levels_before`.

    Attributes:
        step: between two samples, in s.
        every: samples of a bin.
        means, turned: over bins, of what is seen and of the integrated rates.
        near, far: lines through the angles by gravity, and through their difference to `turned`.
        latest: the last two of `means`, for central differences.
        by_gravity: of bins whose line is not known yet: pitch and roll by gravity, whether
            rates are missing, and whether forces are.
        tilts: pitch and roll by that line, both by gravity bin by bin, and the same two.
        swung: of bins whose difference is not known yet: `turned`, and whether forces are missing.
        more: what is added to the integrated rates: pitch, roll, and whether one of them or a
            force is unknown.
        memory: of the integration.
    """

    step: float
    every: int
    means: Means
    turned: Means
    near: LocalLines
    far: LocalLines
    latest: FloatArray = field(default_factory=lambda: np.full((6, 1), np.nan))
    by_gravity: Held = field(default_factory=lambda: Held.of(4))
    tilts: Held = field(default_factory=lambda: Held.of(6))
    swung: Held = field(default_factory=lambda: Held.of(3))
    more: Held = field(default_factory=lambda: Held.of(3))
    memory: np.record = field(default_factory=_no_angles)
    ended: bool = False

    @classmethod
    def of(cls, step: float, far_s: float) -> "Attitude":
        """Return one of samples ``step`` in s apart; ``far_s`` parts slow from fast."""
        every = max(1, round(BIN_S / step))
        h = every * step
        near = LocalLines.of(NEAR_S / h, NEVER)
        far = LocalLines.of(far_s / h, max(1, round(PATIENCE_S / h)))
        return cls(step, every, Means(every, 6), Means(every, 2), near, far)

    @property
    def turns_before(self) -> int:
        """Samples before this one can be turned."""
        return self.tilts.end * self.every

    @property
    def levels_before(self) -> int:
        """Samples before this one can be levelled: half a bin further would do."""
        return (self.more.end if self.ended else self.more.end - 1) * self.every

    def see(self, rows: FloatArray) -> None:
        """Take the next samples, shape (6, n), NaN if missing.

        They are longitudinal and lateral specific force, the rates of roll, pitch and yaw, and the
        encoder's distance.
        """
        self._tell(self.means.take(rows))

    def see_end(self) -> None:
        """Know that there is no more to be seen: all the rest can be turned."""
        cut = self.means.rest()
        cut[2:] = np.nan
        self._tell(cut)
        self._tell(np.full((6, 1), np.nan))
        self._tilt(self.near.rest())

    def turn(self, rates: FloatArray, at: int) -> FloatArray:
        """Return the integrated rates of pitch and roll at the samples from number ``at`` on.

        ``rates``, shape (3, n), are those of roll, pitch and yaw.
        """
        from floatref.estimators.levelling import kernel

        found = np.empty((2, rates.shape[1]))
        angles = self.tilts.values[:2].copy()
        begin, half = at - self.tilts.first * self.every, 0.5 * self.step
        kernel.turn(rates, angles, begin, self.every, half, self.memory, found)
        self._part(self.turned.take(found))
        return found

    def turn_end(self) -> None:
        """Know that all has been turned: all the rest can be levelled."""
        self._part(self.turned.rest())
        self._add(self.far.rest())
        self.ended = True

    def level(self, force: FloatArray, turned: FloatArray, at: int) -> tuple[FloatArray, BoolArray]:
        """Return the vertical acceleration from sample ``at`` on, and where it is not known.

        ``force``, shape (3, n), is the specific force along body X, Y and Z.
        """
        from floatref.estimators.levelling import kernel

        found, last = np.empty(force.shape[1]), at + int(force.shape[1]) - 1
        self.more.drop_before(at // self.every - 1)
        begin, more = at - self.more.first * self.every, self.more.values
        kernel.level(force, turned, more[:2].copy(), begin, self.every, STANDARD_GRAVITY, found)
        of_bin = np.arange(at, last + 1) // self.every - self.more.first
        return found, more[2][of_bin] > 0.0

    def angles(self, turned: FloatArray, at: int) -> tuple[FloatArray, BoolArray]:
        """Return pitch and roll in rad from sample ``at`` on, shape (2, n), and where unknown."""
        from floatref.estimators.levelling import kernel

        found, count = turned.copy(), turned.shape[1]
        self.more.drop_before(at // self.every - 1)
        begin, added = at - self.more.first * self.every, np.empty(count)
        for angle, bins in zip(found, self.more.values, strict=False):
            kernel.between_bins(bins.copy(), begin, self.every, added)
            angle += added
        of_bin = np.arange(at, at + count) // self.every - self.more.first
        return found, self.more.values[2][of_bin] > 0.0

    def _tell(self, means: FloatArray) -> None:
        """Compute the angles by gravity up to the bin before the last of ``means``."""
        wide = np.concatenate((self.latest, means), axis=1)
        self.latest = wide[:, -2:].copy()
        before, now, after = wide[:, :-2], wide[:, 1:-1], wide[:, 2:]
        h = self.every * self.step
        along = (after[5] - 2.0 * now[5] + before[5]) / h**2
        speed = (after[5] - before[5]) / (2.0 * h)
        sines = np.vstack((along - now[0], now[1] - speed * now[4])) / STANDARD_GRAVITY
        silent, lost = (
            np.isnan(rows.sum(axis=0)).astype(np.float64) for rows in (now[2:5], now[:2])
        )
        self.by_gravity.add(sines, silent, lost)
        self._tilt(self.near.take(sines, silent))

    def _tilt(self, lines: FloatArray) -> None:
        from floatref.estimators.levelling import kernel

        known = self.by_gravity.take(lines.shape[1])
        found = np.empty((4, lines.shape[1]))
        kernel.slow(known[:2].copy(), lines, found)
        self.tilts.add(found, known[2:])

    def _part(self, turned: FloatArray) -> None:
        """Compare with the angles by gravity."""
        known = self.tilts.take(turned.shape[1])
        silent = known[4]
        off = np.where(silent > 0.0, np.nan, known[2:4] - turned)
        self.swung.add(turned, known[5:])
        self._add(self.far.take(off, silent))

    def _add(self, lines: FloatArray) -> None:
        known = self.swung.take(lines.shape[1])
        unknown = np.isnan(lines)
        lost = unknown.any(axis=0) | (known[2] > 0.0)
        self.more.add(np.where(unknown, -known[:2], lines), lost)
