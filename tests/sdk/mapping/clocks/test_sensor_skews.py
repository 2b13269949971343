"""What the sensors of a wheel path say of each other is told of every native file."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from floatref.mapping import Reading, read_native

MAP = """format = "floatref-map/1"
[[channels]]
native = "force"
channel = "vertical_specific_force"
unit = "m/s^2"
[[channels]]
native = "laser"
channel = "height"
unit = "mm"
offset = 300
HERE
[[channels]]
native = "odo"
channel = "distance"
unit = "m"
"""


@pytest.fixture
def read(
    put: Callable[..., Path], make_stream: Any, tmp_path: Path
) -> Callable[[str, float], Reading]:
    """Read a vehicle that stops after 3 s and swings on, its laser late, by a map."""

    def of(stated: str, late_s: float) -> Reading:
        times = np.arange(8000) / 1000

        def swing(t: np.ndarray) -> np.ndarray:
            return np.exp(-0.5 * t) * np.sin(9.0 * t)

        force = (0.25 - 81.0) * swing(times) - 9.0 * np.exp(-0.5 * times) * np.cos(9.0 * times)
        columns = {
            "force": 9.80665 + 0.01 * force,
            "laser": 10.0 * swing(times - late_s),
            "odo": 5.0 * np.minimum(times, 3.0),
        }
        (tmp_path / "map.toml").write_text(MAP.replace("HERE", stated))
        return read_native(
            put(make_stream("adc", columns, rate=Fraction(1000))), tmp_path / "map.toml"
        )

    return of


def test_sensors_at_one_give_no_warning(read: Callable[[str, float], Reading]) -> None:
    reading = read("", 0.0)
    assert reading.warnings == ()
    (skew,) = reading.skews
    assert abs(skew["skew_s"]) < 5e-5


def test_a_late_laser_is_told_and_cured_by_the_delay_that_is_told(
    read: Callable[[str, float], Reading],
) -> None:
    (line,) = read("", 0.002).warnings
    assert line.startswith("channel height: 2.0")
    delay = line.partition("add ")[2].partition(" to its delay_s")[0]
    cured = read(f"delay_s = {delay}", 0.002)
    assert cured.warnings == ()
    assert abs(cured.skews[0]["skew_s"]) < 5e-5


@pytest.mark.parametrize(
    ("stated", "said"),
    [("scale = -1", "moves -1 times"), ("scale = 10", "moves 10 times")],
)
def test_a_height_that_moves_otherwise_than_the_accelerometer_is_told(
    read: Callable[[str, float], Reading], stated: str, said: str
) -> None:
    (line,) = read(stated, 0.0).warnings
    assert line.startswith(f"channel height: {said} as far as the accelerometer")
