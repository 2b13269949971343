"""The observer with unknown inputs (10)-(11) of Imine, one loop over its sampled equations.

Two sets of matrices take the state from sample to sample: with the innovation G (y - C'x) and,
where a value is absent, without it. An absent acceleration is the one before it.
"""

from floatref.kernels.compiling import compiled
from floatref.values.arrays import BoolArray, FloatArray

STARTED, BROKEN, LEFT, HELD = 0, 1, 2, 3
"""Places in the memory: begun, samples until the newest inputs are whole, samples until the error
has decayed; the newest inputs, the last sample first, begin at `HELD`, then the state."""


@compiled
def observe(
    transition: FloatArray,
    taps: FloatArray,
    start: FloatArray,
    road_of_state: FloatArray,
    road_of_input: FloatArray,
    settling: int,
    inputs: FloatArray,
    memory: FloatArray,
    states: FloatArray,
    road: FloatArray,
    settled: BoolArray,
) -> None:
    """Write state and road by (10) and (11) of Imine, and whether the start's error has decayed.

    ``transition`` (2, s, s) acts on the last state, ``taps`` (2, d, s, m) on the inputs of the
    sample and of those before it; the second of each has no innovation. ``start`` (s, m) makes
    the first state of the first sample without absent values; up to there all is NaN. The road
    is ``road_of_state`` (p, s) and ``road_of_input`` (p, m) of both. ``settling`` samples in a
    row without absent values make an estimate settled. ``inputs`` has the shape (N, m), NaN is
    absent; ``states`` (N, s), ``road`` (N, p).
    """
    d, m, s = taps.shape[1], inputs.shape[1], states.shape[1]
    held, state = memory[HELD : HELD + d * m], memory[HELD + d * m : HELD + d * m + s]
    for i in range(inputs.shape[0]):
        absent = _is_absent(inputs[i])
        if memory[STARTED] == 0.0 and absent:
            states[i] = road[i] = float("nan")
            settled[i] = False
            continue
        memory[BROKEN] = d if absent else max(memory[BROKEN] - 1.0, 0.0)
        memory[LEFT] = settling if absent else max(memory[LEFT] - 1.0, 0.0)
        if memory[STARTED] == 0.0:
            memory[STARTED], memory[LEFT] = 1.0, settling
            for j in range(d):
                held[j * m : (j + 1) * m] = inputs[i]
            _multiply(start, held[:m], states[i], False)
        else:
            which = 0 if memory[BROKEN] == 0.0 else 1
            held[m:] = held[:-m].copy()
            _hold(inputs[i], held[:m])
            _multiply(transition[which], state, states[i], False)
            for j in range(d):
                _multiply(taps[which, j], held[j * m : (j + 1) * m], states[i], True)
        state[:] = states[i]
        _multiply(road_of_state, state, road[i], False)
        _multiply(road_of_input, held[:m], road[i], True)
        settled[i] = memory[LEFT] == 0.0


@compiled
def _is_absent(values: FloatArray) -> bool:
    absent = False
    for value in values:
        absent = absent or value != value
    return absent


@compiled
def _hold(values: FloatArray, held: FloatArray) -> None:
    for j in range(values.size):
        if values[j] == values[j]:
            held[j] = values[j]


@compiled
def _multiply(matrix: FloatArray, vector: FloatArray, result: FloatArray, add: bool) -> None:
    for row in range(matrix.shape[0]):
        total = result[row] if add else 0.0
        for column in range(matrix.shape[1]):
            total += matrix[row, column] * vector[column]
        result[row] = total
