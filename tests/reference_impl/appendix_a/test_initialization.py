"""First outputs worked out by hand for c = 1/2, where Table A.1 holds simple fractions."""

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest

from floatref_reference.appendix_a import filters

F_C = math.atan(0.5) / math.pi
IMPULSE = [1.0, 0.0, 0.0]
BY_HAND = {
    "lpf_b3s1": [1, 2 / 3, 2 / 9],
    "lpf_b3s2": [1, 6 / 7, 22 / 49],
    "hpf_b3s1": [1 / 3, -5 / 9, -5 / 27],
    "hpf_b3s2": [3 / 7, -19 / 49, 19 / 343],
}
ALL = [stage + direction for stage in BY_HAND for direction in ("", "r")]

Stage = Callable[[npt.ArrayLike, float, float], npt.NDArray[np.longdouble]]


def stage(name: str) -> Stage:
    found: Stage = getattr(filters, name)
    return found


@pytest.mark.cites("(A.9)", "(A.12) to (A.15)")
@pytest.mark.parametrize(("name", "expected"), BY_HAND.items())
def test_forward_stage_starts_as_printed(name: str, expected: list[float]) -> None:
    assert stage(name)(IMPULSE, F_C, 1.0) == pytest.approx(expected, rel=1e-14)


@pytest.mark.cites("(A.10)", "(A.16) to (A.19)")
@pytest.mark.parametrize(("name", "expected"), BY_HAND.items())
def test_reverse_stage_starts_at_the_end(name: str, expected: list[float]) -> None:
    y = stage(f"{name}r")(IMPULSE[::-1], F_C, 1.0)
    assert y == pytest.approx(expected[::-1], rel=1e-14)


@pytest.mark.parametrize("name", [name for name in ALL if name.startswith("lpf")])
def test_low_pass_stage_holds_a_constant(name: str) -> None:
    y = stage(name)(np.full(50, 3.7), 0.01, 1.0)
    assert y == pytest.approx(np.full(50, 3.7), abs=1e-15)


@pytest.mark.parametrize("direction", [1, -1])
def test_first_order_high_pass_decays_geometrically(direction: int) -> None:
    c = math.tan(math.pi * 0.01)
    name = "hpf_b3s1" if direction == 1 else "hpf_b3s1r"
    y = stage(name)(np.full(50, 3.7), 0.01, 1.0)[::direction]
    assert y == pytest.approx(3.7 * ((1 - c) / (1 + c)) ** np.arange(1, 51), rel=1e-12)


@pytest.mark.parametrize("name", ["hpf_b3s2", "hpf_b3s2r"])
def test_second_order_high_pass_forgets_a_constant(name: str) -> None:
    y = stage(name)(np.full(2000, 3.7), 0.01, 1.0)
    far = y[-1] if name == "hpf_b3s2" else y[0]
    assert abs(far) < 1e-12


@pytest.mark.parametrize("name", ALL)
def test_one_sample_gives_one_output(name: str) -> None:
    first = BY_HAND[name.removesuffix("r")][0]
    assert stage(name)([2.0], F_C, 1.0) == pytest.approx([2 * first], rel=1e-14)
