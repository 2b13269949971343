"""Factors of a sparse normal matrix JᵀJ = L D Lᵀ, by fronts: dense matrices that move along it.

Unknowns are eliminated in an order in which few at a time are together in rows of J. Those that
are now make up the front: each has a slot of it, from the first row that it is in until it is a
pivot. Groups of `PIVOTS` are eliminated at once: their part of all slots, the panel, is taken out
of the front, and what they leave to the others is subtracted from it. What fills in never leaves
the front, so that nothing is looked up, and all inner loops are over slots that follow each other.

For ``groups`` of pivots, fronts of ``width`` slots and n unknowns, numbered as they are eliminated:
``pivots``, shape (groups, PIVOTS), are slots, -1 behind the last unknown; the ``panel``, shape
(groups, PIVOTS, width), is L by slots, each column times its D; and D is the ``diagonal``, shape
(groups, PIVOTS).
"""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray

PIVOTS = 8
"""As many as `_take_products` has terms."""
SLOTS = 4
"""Their number is a multiple of this."""
Shares = tuple[float, float, float, float, float, float, float, float]


@compiled
def give_slots(entering: IndexArray, bounds: IndexArray, slots: IndexArray) -> int:
    """Write the slot of each unknown to ``slots``, shape (n,); return how many there are.

    The unknowns ``entering[bounds[g] : bounds[g + 1]]`` come into the front of the group g, each
    into the first slot that is free; there may be some more, see `SLOTS`.
    """
    taken = np.zeros(slots.size, np.bool_)
    width = 0
    for g in range(bounds.size - 1):
        free = 0
        for e in range(bounds[g], bounds[g + 1]):
            while taken[free]:
                free += 1
            taken[free] = True
            slots[entering[e]] = free
            width = max(width, free + 1)
        for i in range(PIVOTS * g, min(PIVOTS * (g + 1), slots.size)):
            taken[slots[i]] = False
    return -(-width // SLOTS) * SLOTS


@compiled
def factor_fronts(
    values: FloatArray,
    slots: IndexArray,
    starts: IndexArray,
    bounds: IndexArray,
    pivots: IndexArray,
    panel: FloatArray,
    diagonal: FloatArray,
) -> bool:
    """Write the factors to ``panel`` and ``diagonal``; return whether all pivots are above 0.

    Row i of J has ``values[starts[i] : starts[i + 1]]`` in those ``slots``, which rise within it.
    The rows ``bounds[g] : bounds[g + 1]`` are those whose first unknown is in the group g.
    """
    width = panel.shape[2]
    front = np.zeros((width, width))
    scaled = np.empty((PIVOTS, width))
    for g in range(pivots.shape[0]):
        _add_squares(values, slots, starts, bounds[g], bounds[g + 1], front)
        _take(front, pivots[g], panel[g])
        if not _eliminate(panel[g], pivots[g], diagonal[g], scaled):
            return False
        _subtract(front, scaled)
    return True


@compiled
def _add_squares(
    values: FloatArray,
    slots: IndexArray,
    starts: IndexArray,
    begin: int,
    end: int,
    front: FloatArray,
) -> None:
    """Add the products of the values of each row from ``begin`` to ``end`` to the ``front``."""
    for r in range(begin, end):
        for a in range(starts[r], starts[r + 1]):
            value, row = values[a], front[slots[a]]
            for b in range(starts[r], a + 1):
                row[slots[b]] += value * values[b]


@compiled
def _take(front: FloatArray, pivots: IndexArray, panel: FloatArray) -> None:
    """Move the rows of the ``pivots`` from the ``front``, a lower triangle, to the ``panel``."""
    for p in range(PIVOTS):
        q = max(pivots[p], 0)
        if pivots[p] < 0:
            panel[p] = 0.0
            continue
        for i in range(q + 1):
            panel[p, i] = front[q, i]
            front[q, i] = 0.0
        for i in range(q + 1, front.shape[0]):
            panel[p, i] = front[i, q]
            front[i, q] = 0.0


@compiled
def _eliminate(
    panel: FloatArray, pivots: IndexArray, diagonal: FloatArray, scaled: FloatArray
) -> bool:
    """Eliminate the ``pivots`` from each other; return whether all are finite and above 0.

    ``scaled`` is what the panel has in the slots of others, over the root of D.
    """
    for p in range(PIVOTS):
        q = pivots[p]
        d = panel[p, q] if q >= 0 else 1.0
        if not 0.0 < d < np.inf:
            return False
        diagonal[p], panel[p, max(q, 0)] = d, 0.0
        factor = 1.0 / np.sqrt(d)
        for i in range(panel.shape[1]):
            scaled[p, i] = panel[p, i] * factor
        for later in range(p + 1, PIVOTS):
            share = scaled[p, pivots[later]] if pivots[later] >= 0 else 0.0
            for i in range(panel.shape[1]):
                panel[later, i] -= share * scaled[p, i]
            panel[later, max(q, 0)] = 0.0
    for later in range(PIVOTS):
        for p in range(PIVOTS):
            scaled[p, max(pivots[later], 0)] = 0.0
    return True


@compiled
def _subtract(front: FloatArray, scaled: FloatArray) -> None:
    """Subtract the products of the rows of ``scaled`` from the lower triangle of the ``front``."""
    for a in range(front.shape[0]):
        _take_products(front, a, _column(scaled, a), scaled, a + 1)


@compiled
def _column(s: FloatArray, a: int) -> Shares:
    return s[0, a], s[1, a], s[2, a], s[3, a], s[4, a], s[5, a], s[6, a], s[7, a]


@compiled
def _take_products(out: FloatArray, k: int, shares: Shares, s: FloatArray, size: int) -> None:
    """Take the rows of ``s``, shape (PIVOTS, n), each times its share, from the row ``k``.

    One sum of all of them for each place takes a fifth of the time of a loop for each row.
    """
    c0, c1, c2, c3, c4, c5, c6, c7 = shares
    if c0 == c1 == c2 == c3 == c4 == c5 == c6 == c7 == 0.0:
        return
    for i in range(size):
        first = c0 * s[0, i] + c1 * s[1, i] + c2 * s[2, i] + c3 * s[3, i]
        out[k, i] -= first + (c4 * s[4, i] + c5 * s[5, i] + c6 * s[6, i] + c7 * s[7, i])


@compiled
def solve_fronts(
    panel: FloatArray, diagonal: FloatArray, pivots: IndexArray, x: FloatArray
) -> None:
    """Put the solution of L D Lᵀ x = b in place of b in ``x``, shape (groups * PIVOTS,)."""
    front = np.zeros(panel.shape[2])
    for k in range(x.size):
        g, p = divmod(k, PIVOTS)
        q = max(pivots[g, p], 0)
        x[k] += front[q]
        front[q] = 0.0
        share = x[k] / diagonal[g, p]
        for i in range(front.size):
            front[i] -= share * panel[g, p, i]
    front[:] = 0.0
    for k in range(x.size - 1, -1, -1):
        g, p = divmod(k, PIVOTS)
        # Four sums do not wait for each other.
        a, b, c, d = 0.0, 0.0, 0.0, 0.0
        for i in range(0, front.size, SLOTS):
            a += panel[g, p, i] * front[i]
            b += panel[g, p, i + 1] * front[i + 1]
            c += panel[g, p, i + 2] * front[i + 2]
            d += panel[g, p, i + 3] * front[i + 3]
        x[k] = (x[k] - ((a + b) + (c + d))) / diagonal[g, p]
        front[max(pivots[g, p], 0)] = x[k]


@compiled
def multiply_inverse(
    panel: FloatArray,
    diagonal: FloatArray,
    pivots: IndexArray,
    columns: FloatArray,
    product: FloatArray,
) -> None:
    """Take BᵀC B from the lower triangle of ``product``, shape (m, m): C is the inverse of L D Lᵀ.

    B are the ``columns``, shape (groups * PIVOTS, m); they are lost. It is the sum of the squares
    of L⁻¹B over D, so that half of a solution is enough.
    """
    front = np.zeros((panel.shape[2], columns.shape[1]))
    scaled = np.empty((PIVOTS, columns.shape[1]))
    for g in range(panel.shape[0]):
        rows = columns[PIVOTS * g : PIVOTS * (g + 1)]
        _divide(rows, front, pivots[g], panel[g], diagonal[g])
        for p in range(PIVOTS):
            for j in range(rows.shape[1]):
                scaled[p, j] = rows[p, j] / diagonal[g, p]
        for i in range(front.shape[0]):
            _take_products(front, i, _column(panel[g], i), scaled, rows.shape[1])
        for p in range(PIVOTS):
            front[max(pivots[g, p], 0)] = 0.0
        for i in range(rows.shape[1]):
            _take_products(product, i, _column(rows, i), scaled, i + 1)


@compiled
def _divide(
    rows: FloatArray, front: FloatArray, pivots: IndexArray, panel: FloatArray, diagonal: FloatArray
) -> None:
    """Add what the ``front`` has of the ``pivots`` to their ``rows``, and divide these by L."""
    for p in range(PIVOTS):
        for j in range(rows.shape[1] if pivots[p] >= 0 else 0):
            rows[p, j] += front[pivots[p], j]
    for p in range(PIVOTS):
        for later in range(p + 1, PIVOTS):
            share = panel[p, pivots[later]] / diagonal[p] if pivots[later] >= 0 else 0.0
            for j in range(rows.shape[1]):
                rows[later, j] -= share * rows[p, j]
