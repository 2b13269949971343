"""The sizes on the page on the C library are those of the library."""

import re
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[3] / "docs" / "c-library.md").read_text(encoding="utf-8")
ENCODER = {"metres_per_count": 0.001, "rate_hz": 16_000.0}
STEP = {"step": 1 / 16_000.0}
SETTINGS = {
    "filter": {**STEP, "cutoff": 0.45},
    "varying": STEP,
    "integral": {"step_s": 1 / 16_000.0},
    "travel_speed": ENCODER,
    "high_pass_set": {**STEP, "cutoff": 0.45},
    "adaptive_set": {"rate_hz": 16_000.0},
    "adaptive": {"interval_m": 0.025, **{f"travel__{k}": v for k, v in ENCODER.items()}},
    "local_suppression": {"rate_hz": 16_000.0},
    "matched_high_pass": {"rate_hz": 16_000.0},
    "iri": {"interval_m": 0.025},
    "screening": ENCODER,
    "level_fit": {"front_m": 1.5, "rear_m": -1.5},
    "level": {**ENCODER, "fit__front_m": 1.5, "fit__rear_m": -1.5},
    "pitch": {**ENCODER, "front_m": 1.5, "rear_m": -1.5},
    "kalman_filter": {f"travel__{k}": v for k, v in ENCODER.items()},
    "kalman": {"interval_m": 0.025, **{f"filter__travel__{k}": v for k, v in ENCODER.items()}},
    "road_prior": {**ENCODER, "interval_m": 0.025},
    "causes": {**ENCODER, "interval_m": 0.025},
    "saturation": {"range_least": -40.0, "range_greatest": 60.0},
    "encoder_screening": ENCODER,
    "usual": {},
}


@pytest.mark.parametrize("kind", SETTINGS)
def test_an_object_has_the_size_that_the_page_says(double, single, kind):
    (shown,) = re.findall(rf"^\|.* \| `fr_{kind}` \| (\d+), (\d+) \|$", PAGE, re.M)
    sizes = [
        getattr(library.lib, f"fr_{kind}_size")(library.config(kind, **SETTINGS[kind]))
        for library in (double, single)
    ]
    assert sizes == list(map(int, shown))
