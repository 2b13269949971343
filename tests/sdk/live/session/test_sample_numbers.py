"""The number of the next sample is that of the program, whatever never came."""

import numpy as np

from floatref.live.session.messages import Piece, Samples
from floatref.live.session.sample_numbers import SampleNumbers, describe_missing, fill
from floatref.values.clock import UniformClock

START = {"distance": 5, "height": 5}


def test_a_lost_piece_with_times_counts():
    numbers = SampleNumbers({"distance": None, "height": UniformClock.of(10.0)}, START)
    piece = Piece(np.arange(3.0), np.arange(3.0), 8)
    numbered = numbers.number(Samples({"distance": piece, "height": Piece(np.ones(2), None, 9)}))
    missing = {name: each.missing for name, each in numbered.items()}
    assert missing == {"distance": 3, "height": 4}
    assert "distance: 3 samples from number 5 on were" in describe_missing("distance", 3, numbers)
    assert "height: 4 samples from 0.500 s on were" in describe_missing("height", 4, numbers)
    filled = list(fill(numbered, numbers.clocks))
    assert [{name: each.values.size for name, each in pieces.items()} for pieces in filled] == [
        {"height": 4}
    ]
    for pieces in filled:
        numbers.count(pieces)
    numbers.skip(numbered)
    numbers.count({name: each.piece for name, each in numbered.items()})
    assert numbers.next == {"distance": 11, "height": 11}
