"""Length, size and count of every fault, fixed by the edition or drawn."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from floatref_conformance.checks.case import Number
from floatref_conformance.checks.rounded import rounded_numbers

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

Numbers = Mapping[str, "SearchStrategy[Any]"]
NUMBERS: Mapping[str, tuple[Mapping[str, Number], ...]] = MappingProxyType(
    {
        "laser-dropout": ({"length_s": 1.0}, {"length_s": 0.0}, {"length_s": 2.0}),
        "laser-flicker": (
            {"length_s": 0.005, "count": 20, "span_m": 40.0},
            {"length_s": 0.001, "count": 60, "span_m": 20.0},
            {"length_s": 0.02, "count": 40, "span_m": 60.0},
        ),
        "laser-stuck": ({"length_s": 0.6}, {"length_s": 0.1}, {"length_s": 1.0}),
        "laser-out-of-range": (
            {"length_s": 0.1, "side": 1.0},
            {"length_s": 0.01, "side": -1.0},
            {"length_s": 0.5, "side": -1.0},
        ),
        "accelerometer-dropout": ({"length_s": 0.6}, {"length_s": 0.0}, {"length_s": 1.0}),
        "accelerometer-saturation": (
            {"length_s": 0.008, "full_scale_g": 4.0},
            {"length_s": 0.003, "full_scale_g": -2.0},
            {"length_s": 0.02, "full_scale_g": 2.0},
        ),
        "gap": ({"length_s": 0.5}, {"length_s": 0.05}, {"length_s": 1.0}),
        "gap-in-time": ({"length_s": 0.4}, {"length_s": 1.0}, {"length_s": 0.05}),
        "encoder-dropout": ({"length_s": 0.4}, {"length_s": 0.05}, {"length_s": 1.0}),
        "encoder-leap": ({"size_m": 1.0}, {"size_m": 0.1}, {"size_m": 3.0}),
        "encoder-silence": ({"length_s": 0.3}, {"length_s": 0.05}, {"length_s": 1.0}),
        "encoder-lost-counts": ({"length_s": 0.2}, {"length_s": 0.05}, {"length_s": 1.0}),
        "encoder-counts-back": (
            {"count": 5, "size_m": 0.003},
            {"count": 1, "size_m": 0.05},
            {"count": 10, "size_m": 0.001},
        ),
        "encoder-rolling-back": ({"size_m": 0.2}, {"size_m": 0.02}, {"size_m": 0.5}),
        "gnss-outage": ({"length_s": 5.0}, {"length_s": 2.0}, {"length_s": 10.0}),
        "gnss-wrong-fix": (
            {"length_s": 3.0, "size_m": 1.0},
            {"length_s": 2.0, "size_m": -0.3},
            {"length_s": 10.0, "size_m": 3.0},
        ),
        "gnss-float": (
            {"length_s": 6.0, "size_m": 0.4},
            {"length_s": 3.0, "size_m": -0.2},
            {"length_s": 10.0, "size_m": 1.0},
        ),
        "gnss-jump": ({"size_m": 1.0}, {"size_m": -0.3}, {"size_m": 3.0}),
        "gnss-stuck": ({"length_s": 4.0}, {"length_s": 2.0}, {"length_s": 8.0}),
        "gnss-never-fixed": ({"size_m": 0.5}, {"size_m": -0.2}, {"size_m": 1.5}),
        "gnss-outage-at-a-stop": ({"length_s": 15.0}, {"length_s": 30.0}, {"length_s": 8.0}),
        "imu-gyro-gap": ({"length_s": 1.0}, {"length_s": 0.2}, {"length_s": 0.5}),
        "imu-flicker": (
            {"count": 20, "span_m": 40.0},
            {"count": 5, "span_m": 10.0},
            {"count": 60, "span_m": 60.0},
        ),
        "response-wheel-dropout": ({"length_s": 0.4}, {"length_s": 0.0}, {"length_s": 1.0}),
        "response-wheel-stuck": ({"length_s": 0.5}, {"length_s": 0.1}, {"length_s": 1.0}),
        "response-wheel-saturation": (
            {"length_s": 0.01, "full_scale_g": 10.0},
            {"length_s": 0.005, "full_scale_g": -10.0},
            {"length_s": 0.02, "full_scale_g": 8.0},
        ),
        "response-body-dropout": ({"length_s": 0.6}, {"length_s": 0.0}, {"length_s": 1.0}),
        "response-deflection-dropout": ({"length_s": 0.5}, {"length_s": 0.0}, {"length_s": 1.0}),
        "response-deflection-stuck": ({"length_s": 0.6}, {"length_s": 0.1}, {"length_s": 1.0}),
    }
)
"""For each fault, the numbers of the seeded cases in turn."""
FULL_SCALES_G = (-5.0, -4.0, -2.0, 2.0, 4.0, 5.0)
WHEEL_SCALES_G = (-16.0, -10.0, -8.0, 8.0, 10.0, 16.0)


def number_strategies(fault: str) -> Numbers:
    """Return strategies of the numbers of ``fault``."""
    from hypothesis import strategies as st

    numbers: Mapping[str, Numbers] = {
        "laser-dropout": {"length_s": rounded_numbers(0.0, 2.0, 2)},
        "laser-flicker": {
            "length_s": rounded_numbers(0.001, 0.02, 3),
            "count": st.integers(5, 60),
            "span_m": rounded_numbers(5.0, 60.0),
        },
        "laser-stuck": {"length_s": rounded_numbers(0.1, 1.0, 2)},
        "laser-out-of-range": {
            "length_s": rounded_numbers(0.01, 0.5, 2),
            "side": st.sampled_from((-1.0, 1.0)),
        },
        "accelerometer-dropout": {"length_s": rounded_numbers(0.0, 1.0, 2)},
        "accelerometer-saturation": {
            "length_s": rounded_numbers(0.002, 0.02, 3),
            "full_scale_g": st.sampled_from(FULL_SCALES_G),
        },
        "encoder-leap": {"size_m": rounded_numbers(0.1, 3.0, 2)},
        "encoder-counts-back": {
            "count": st.integers(1, 10),
            "size_m": rounded_numbers(0.001, 0.05, 3),
        },
        "encoder-rolling-back": {"size_m": rounded_numbers(0.02, 0.5, 2)},
        "gnss-outage": {"length_s": rounded_numbers(2.0, 10.0)},
        "gnss-wrong-fix": {
            "length_s": rounded_numbers(2.0, 10.0),
            "size_m": rounded_numbers(-3.0, 3.0),
        },
        "gnss-float": {
            "length_s": rounded_numbers(2.0, 10.0),
            "size_m": rounded_numbers(-1.0, 1.0),
        },
        "gnss-jump": {"size_m": rounded_numbers(0.3, 3.0) | rounded_numbers(-3.0, -0.3)},
        "gnss-stuck": {"length_s": rounded_numbers(2.0, 10.0)},
        "gnss-never-fixed": {"size_m": rounded_numbers(-1.5, 1.5)},
        "gnss-outage-at-a-stop": {"length_s": rounded_numbers(8.0, 30.0)},
        "imu-flicker": {"count": st.integers(5, 60), "span_m": rounded_numbers(5.0, 60.0)},
        "response-wheel-dropout": {"length_s": rounded_numbers(0.0, 1.0, 2)},
        "response-wheel-stuck": {"length_s": rounded_numbers(0.1, 1.0, 2)},
        "response-wheel-saturation": {
            "length_s": rounded_numbers(0.002, 0.02, 3),
            "full_scale_g": st.sampled_from(WHEEL_SCALES_G),
        },
        "response-deflection-stuck": {"length_s": rounded_numbers(0.1, 1.0, 2)},
    }
    return numbers.get(fault, {"length_s": rounded_numbers(0.05, 1.0, 2)})
