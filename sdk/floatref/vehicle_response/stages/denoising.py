"""Noise removed from a channel by singular spectrum analysis, as in section 5 of Zhu.

The channel is laid out in lagged windows of L samples; of the principal components of these, some
are kept, and the windows are laid back over each other: the form of Broomhead and King, in which
the lag-covariance matrix need not be Toeplitz.
"""

from collections.abc import Sequence
from math import isfinite, log, sqrt
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.stages.marks import flags_of
from floatref.stages.protocol import Declared, Stage
from floatref.values.arrays import FloatArray
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId


def remove_noise(
    samples: ArrayLike,
    window: int,
    *,
    components: int | None = None,
    share: float | None = None,
    noise: float | None = None,
) -> FloatArray:
    """Return ``samples``, shape (N,), without the components of the least variance.

    So section 5 of Zhu removes noise from measured signals. ``window`` is L in samples, from 2 to
    N/2. Give one of three criteria: the number of ``components``, their least ``share`` of the mean
    square, above 0 and up to 1, or the standard deviation of white ``noise``, in the unit of the
    samples, whose variance they exceed. Memory is that of a few copies of the samples. Raises
    InputError for a missing (NaN) sample, another shape or window, or unless one of the three is
    given and in its range.
    """
    channel = _check(samples, window)
    variances, vectors = singular_spectrum(channel, window)
    kept = _count_components(variances, channel.size - window + 1, components, share, noise)
    return reconstruct(channel, vectors[:, :kept])


def singular_spectrum(samples: ArrayLike, window: int) -> tuple[FloatArray, FloatArray]:
    """Return variances (L,), from the largest, and vectors (L, L) in columns, of lagged windows.

    The mean is not subtracted. Raises InputError as `remove_noise` does.
    """
    import scipy.linalg

    channel = _check(samples, window)
    rows = channel.size - window + 1
    lagged = np.lib.stride_tricks.sliding_window_view(channel, rows)
    covariance = np.zeros((window, window))
    for lag in range(window):
        # Along a diagonal the sum of products loses one at its begin and gains one at its end.
        product = channel[: channel.size - lag] * channel[lag:]
        change = product[rows : rows + window - 1 - lag] - product[: window - 1 - lag]
        first = float(lagged[0] @ lagged[lag])
        diagonal = np.concatenate(([first], first + np.cumsum(change)))
        covariance[np.arange(window - lag), np.arange(lag, window)] = diagonal
    variances, vectors = scipy.linalg.eigh(covariance, lower=False)
    return np.maximum(variances[::-1], 0.0) / rows, np.ascontiguousarray(vectors[:, ::-1])


def reconstruct(samples: ArrayLike, vectors: FloatArray) -> FloatArray:
    """Return the part of ``samples`` (N,) that lies along orthonormal ``vectors`` (L, r).

    Every window is projected, and each sample is the mean over the windows that hold it. Raises
    InputError as `remove_noise` does.
    """
    from scipy.signal import oaconvolve

    window = vectors.shape[0]
    channel = _check(samples, window)
    total = np.zeros(channel.size)
    for vector in vectors.T:
        component = oaconvolve(channel, vector[::-1], mode="valid")
        total += oaconvolve(component, vector)
    place = np.arange(1, channel.size + 1)
    holding = np.minimum(np.minimum(place, place[::-1]), window)
    return np.asarray(total / holding)


def _count_components(
    variances: FloatArray,
    rows: int,
    components: int | None,
    share: float | None,
    noise: float | None,
) -> int:
    """Return the number of components that are used."""
    if [components, share, noise].count(None) != 2:
        raise InputError("denoising: give exactly one of components, share and noise")
    if components is not None:
        if not 1 <= components <= variances.size:
            raise InputError(f"denoising: {components} components; give 1 to {variances.size}")
        return components
    if share is not None:
        if not 0 < share <= 1:
            raise InputError(f"denoising: a share of {share:g}; give one above 0 and up to 1")
        reached = np.cumsum(variances)
        return int(np.searchsorted(reached, share * reached[-1] * (1 - 1e-12))) + 1
    return _above(variances, rows, noise)


def _above(variances: FloatArray, rows: int, noise: float | None) -> int:
    """Return how many variances exceed those of white noise in ``rows`` windows."""
    if noise is None or not (isfinite(noise) and noise >= 0):
        raise InputError(f"denoising: the noise is {noise}; give its standard deviation")
    size = variances.size
    return int(np.count_nonzero(variances > noise**2 * (1 + sqrt(2 * size * log(size) / rows))))


def _check(samples: ArrayLike, window: int) -> FloatArray:
    channel = np.asarray(samples, dtype=np.float64)
    if channel.ndim != 1:
        raise InputError(f"denoising: samples of the shape {channel.shape}; give one channel")
    if not 2 <= window <= channel.size // 2:
        raise InputError(
            f"denoising: a window of {window} of {channel.size} samples; give 2 to half of them"
        )
    if not np.isfinite(channel).all():
        where = int(np.flatnonzero(~np.isfinite(channel))[0])
        raise InputError(f"denoising: sample {where} is {channel[where]}; bridge gaps before")
    return channel


class Denoise(Stage):
    """Keeps ``components`` principal components of the windows of each of ``names``.

    The whole run is held back, since the components are those of all windows; a missing sample is
    bridged by 0, as a high-passed signal has it, and flagged.
    """

    declared: ClassVar[Declared] = Declared(linear=False, delay=1 << 62)

    def __init__(self, names: Sequence[str], components: int, window_s: float) -> None:
        """Denoise channels called one of ``names``, in windows of ``window_s``."""
        super().__init__()
        self.names, self.components, self.window_s = tuple(names), components, window_s
        self._window = 2
        self._channels: tuple[ChannelId, ...] = ()

    def open(self, header: Header) -> Header:
        """Ask for the channels, in time; InputError for more components than a window has."""
        if header.axis is not Axis.TIME:
            raise InputError(f"stage {self.name}: the stream is not on the time axis")
        self._window = max(2, round(self.window_s / header.step))
        if self.components > self._window:
            raise InputError(
                f"stage {self.name}: {self.components} components of a window of {self._window} "
                "samples; give fewer, or a longer window"
            )
        self._channels = tuple(ChannelId(n, track) for n in self.names for track in header.tracks)
        header.require(self.name, *self._channels)
        self.memory = {"blocks": []}
        return header

    def advance(self, block: Block) -> Block:
        """Hold the block back."""
        blocks: list[Block] = self.memory["blocks"]
        if len(block):
            blocks.append(block)
        return (blocks[0] if blocks else block).part(0, 0)

    def close(self) -> tuple[Block, ...]:
        """Return the whole run."""
        if not self.memory["blocks"]:
            return ()
        whole = join_blocks(self.memory["blocks"])
        window = min(self._window, len(whole) // 2)
        values, flags = {}, {}
        for channel in self._channels:
            marks = flags_of(whole, channel)
            if marks is not None:
                flags[channel] = marks
            if window >= 2:
                kept = min(self.components, window)
                values[channel] = remove_noise(
                    np.nan_to_num(whole[channel]), window, components=kept
                )
        return (whole.setting(values, flags),)
