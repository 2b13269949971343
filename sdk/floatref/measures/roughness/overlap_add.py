"""The convolution of two signals by Fourier transforms, of a long one in blocks that overlap.

`scipy.signal.oaconvolve` does the same, but to load it takes half a second, more than the IRI of
some kilometres does; sizes and order of operations are its own, and so are the results.
"""

from math import ceil, e, log

import numpy as np

from floatref.values.arrays import FloatArray

BLOCK_PRIMES, WHOLE_PRIMES = (2, 3, 5, 7, 11), (2, 3, 5)
"""Of the sizes for which a transform is fast: in blocks, and of a signal as a whole."""
ROUNDS = 60


def convolve(x: FloatArray, y: FloatArray) -> FloatArray:
    """Return Σ_k x_k y_(n−k) for all n where there is a term, shape (x.size + y.size − 1,)."""
    full, block = x.size + y.size - 1, _block_size(x.size, y.size)
    if block >= max(x.size, y.size):
        size = _fast_size(full, WHOLE_PRIMES)
        return np.fft.irfft(np.fft.rfft(x, size) * np.fft.rfft(y, size), size)[:full]
    long, short = (x, y) if x.size >= y.size else (y, x)
    step = block - short.size + 1
    pieces = np.zeros((ceil(full / step), step))
    pieces.reshape(-1)[: long.size] = long
    spectra, filtering = np.fft.rfft(pieces, block), np.fft.rfft(short, block)
    # The order of a product decides its last bit where the processor fuses operations.
    product = spectra * filtering if long is x else filtering * spectra
    blocks = np.fft.irfft(product, block)
    blocks[1:, : short.size - 1] += blocks[:-1, step:]
    found = np.concatenate((blocks[:, :step].reshape(-1), blocks[-1, step:]))
    return found[:full]


def middle(found: FloatArray, size: int) -> FloatArray:
    """Return the ``size`` values in the middle of ``found``."""
    first = (found.size - size) // 2
    return found[first : first + size]


def _block_size(one: int, other: int) -> int:
    """Return the size of a transform; that of the longer signal where blocks gain nothing.

    A transform of N points, of which K are shared with the next, costs N log(2N) for N − K new
    ones. That is least where N = K log(2eN).
    """
    short, long = sorted((one, other))
    shared = short - 1
    if shared == 0 or short >= long / 2:
        return long
    size = float(shared)
    for _ in range(ROUNDS):
        size = shared * log(2.0 * e * size)
    return min(_fast_size(ceil(size), BLOCK_PRIMES), long)


def _fast_size(least: int, primes: tuple[int, ...]) -> int:
    """Return the least product of ``primes`` that is not below ``least``."""
    size = least
    while not _is_product(size, primes):
        size += 1
    return size


def _is_product(size: int, primes: tuple[int, ...]) -> bool:
    for prime in primes:
        while size % prime == 0:
            size //= prime
    return size == 1
