"""A line across a surface: bilinear as plain loops are, refused over holes and beyond the edges."""

import subprocess
import sys
from math import floor

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.roads.surface import Surface

RIGHT_M, ACROSS_M = -0.3, 0.05


def surface(seed: int, strings: int = 9, points: int = 40, kind: type = np.float64) -> Surface:
    z = np.random.default_rng(seed).standard_normal((strings, points)).astype(kind)
    return Surface(-2.0, 0.025, RIGHT_M, ACROSS_M, z)


def by_hand(ground: Surface, y: FloatArray) -> list[float]:
    """Return the elevation along a line, point after point."""
    found = []
    for k, lateral in enumerate(y):
        position = (lateral - ground.right_m) / ground.across_m
        string = min(floor(position), ground.elevation.shape[0] - 2)
        right, left = (float(ground.elevation[string + side, k]) for side in (0, 1))
        found.append(right + (position - string) * (left - right))
    return found


@pytest.mark.slow
@given(st.integers(0, 999), st.sampled_from([np.float32, np.float64]), st.data())
@settings(deadline=None)
def test_a_line_is_what_plain_loops_find(seed: int, kind: type, data: st.DataObject) -> None:
    ground = surface(seed, kind=kind)
    lateral = st.floats(ground.right_m, ground.left_m)
    y = np.array(data.draw(st.lists(lateral, min_size=40, max_size=40)))
    assert ground.line(y) == pytest.approx(by_hand(ground, y), abs=2e-5)
    assert ground.elevation.dtype == kind


def test_a_plane_is_met_exactly_by_a_line_given_as_a_function() -> None:
    x, y = -2.0 + 0.025 * np.arange(40), RIGHT_M + ACROSS_M * np.arange(9)
    ground = Surface(-2.0, 0.025, RIGHT_M, ACROSS_M, 0.02 * x + 0.3 * y[:, None])
    found = ground.line(lambda at: 0.1 * np.sin(at))
    assert found == pytest.approx(0.02 * x + 0.03 * np.sin(x), abs=1e-12)


@pytest.mark.parametrize("string", range(9))
def test_a_line_on_a_string_is_that_string_bit_for_bit(string: int) -> None:
    ground = surface(1)
    z = ground.elevation.copy()
    z[[k for k in range(9) if k != string]] = np.nan
    alone = Surface(-2.0, 0.025, RIGHT_M, ACROSS_M, z)
    y = np.full(40, RIGHT_M + ACROSS_M * string)
    assert np.array_equal(alone.line(y), ground.elevation[string])


def test_holes_and_edges_are_refused_where_they_are_and_nowhere_else() -> None:
    z = np.zeros((9, 40))
    z[4, 20] = np.nan
    ground = Surface(-2.0, 0.025, RIGHT_M, ACROSS_M, z)
    assert not ground.line(np.full(40, 0.0)).any()
    for lateral in (-0.1, -0.12, -0.06):
        with pytest.raises(InputError, match=rf"line at -1\.50 m, {lateral:.3f} m .* hole"):
            ground.line(np.full(40, lateral))
    y = np.zeros(40)
    for beyond in (0.11, -0.31):
        y[30] = beyond
        with pytest.raises(InputError, match=r"line at -1\.25 m.*reaches from -0\.3 to 0\.1 m"):
            ground.line(y)


def test_a_surface_is_read_only_and_not_copied() -> None:
    z = np.zeros((3, 4), np.float32)
    ground = Surface(0.0, 1.0, 0.0, 1.0, z)
    assert np.shares_memory(ground.elevation, z)
    with pytest.raises(ValueError, match="read-only"):
        ground.elevation[0, 0] = 1.0


@pytest.mark.parametrize(
    ("spacing", "across", "z", "message"),
    [
        (0.0, 1.0, np.zeros((2, 2)), "spacing_m is 0.0"),
        (1.0, float("nan"), np.zeros((2, 2)), "across_m is nan"),
        (1.0, 1.0, np.zeros((1, 5)), "shape"),
        (1.0, 1.0, np.zeros(5), "shape"),
        (1.0, 1.0, np.zeros((2, 2), int), "float32 or float64"),
    ],
)
def test_an_impossible_grid_is_refused(
    spacing: float, across: float, z: FloatArray, message: str
) -> None:
    with pytest.raises(InputError, match=message):
        Surface(0.0, spacing, 0.0, across, z)


TEN_KILOMETRES = """
import numpy as np
from floatref_conformance.proving_ground.roads.surface import Surface
strings, points = 121, 400_001
z = np.empty((strings, points), np.float32)
for string in range(strings):
    z[string] = string + np.arange(points) % 7
ground = Surface(0.0, 0.025, -1.5, 0.025, z)
assert abs(ground.line(lambda x: 1.4 * np.sin(x / 50))[0] - 60) < 1e-6
for line in open("/proc/self/status"):
    if line.startswith("VmHWM"):
        print(int(line.split()[1]) / 1024)
"""
"""`getrusage` would have the parent's largest size after a fork, too."""


@pytest.mark.posix
@pytest.mark.slow
def test_ten_kilometres_at_25_mm_and_3_m_wide_fit_in_600_mb() -> None:
    command = [sys.executable, "-c", TEN_KILOMETRES]
    found = subprocess.run(command, capture_output=True, text=True, check=True)
    assert float(found.stdout) < 600
