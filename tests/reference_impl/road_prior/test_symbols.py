"""Recorded signals fit together, or are refused."""

import numpy as np
import pytest

from floatref_reference.road_prior.symbols import recorded

T = [0.0, 0.1, 0.2]


def test_signals_of_one_track_get_their_axes() -> None:
    run = recorded(T, [0, 1, 1], [0, 0, 0], [0.3, np.nan, 0.3])
    assert (run.a_m.shape, run.h.shape, run.u.shape) == ((1, 3), (1, 3), (1, 3, 0))
    assert run.a_x.tolist() == [0, 0, 0]


def test_inputs_that_tracks_have_in_common_are_given_once() -> None:
    u = np.arange(6.0).reshape(3, 2)
    run = recorded(T, T, np.zeros((2, 3)), np.zeros((2, 3)), u, a_x=[1, 2, 3])
    assert np.array_equal(run.u, [u, u])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"t": [0, 0.1, 0.1]}, "does not increase"),
        ({"distance": [0, 1, 0.9]}, "decreases"),
        ({"distance": [0, 1]}, "do not fit"),
        ({"h": [0.3, 0.3]}, "do not fit"),
        ({"a_m": [0, np.nan, 0]}, "NaN or infinity"),
        ({"a_x": [0, np.inf, 0]}, "NaN or infinity"),
    ],
)
def test_signals_that_cannot_be_are_refused(change: dict[str, object], message: str) -> None:
    good = {"t": T, "distance": T, "a_m": [0, 0, 0], "h": [0.3, 0.3, 0.3]}
    with pytest.raises(ValueError, match=message):
        recorded(**{**good, **change})
