"""Settings of the C library: the ranges that its header gives, and what all have in common."""

import re
from functools import reduce

import numpy as np
import pytest

import floatref

HEADER = (floatref.c_sources() / "floatref.h").read_text(encoding="utf-8")
KINDS = re.findall(r"^FR_API size_t fr_(\w+)_size\(const fr_\w+_config \*config\);", HEADER, re.M)
ENCODER = {"metres_per_count": 0.001, "rate_hz": 1000.0}
AXLES = {"front_m": 1.5, "rear_m": -1.5}
TRAVEL = {f"travel__{name}": value for name, value in ENCODER.items()}
POINTS = {**ENCODER, "interval_m": 0.025}
POSSIBLE = {
    "filter": {"step": 1e-3, "cutoff": 0.45},
    "varying": {"step": 1e-3},
    "integral": {"step_s": 1e-3},
    "travel_speed": ENCODER,
    "projection": {"metres_per_count": 0.001, "interval_m": 0.025},
    "time_step": {"seconds_per_tick": 1e-6},
    "high_pass_set": {"step": 1e-3, "cutoff": 0.45},
    "adaptive_set": {"rate_hz": 1000.0},
    "adaptive": {"interval_m": 0.025, **TRAVEL},
    "local_suppression": {"rate_hz": 1000.0},
    "matched_high_pass": {"rate_hz": 1000.0},
    "road_prior": POINTS,
    "iri": {"interval_m": 0.025},
    "causes": POINTS,
    "screening": ENCODER,
    "saturation": {"range_least": -40.0, "range_greatest": 60.0},
    "encoder_screening": ENCODER,
    "usual": {},
    "kalman_filter": TRAVEL,
    "kalman": {"interval_m": 0.025, **{f"filter__{name}": v for name, v in TRAVEL.items()}},
    "level_fit": AXLES,
    "level": {**ENCODER, **{f"fit__{name}": v for name, v in AXLES.items()}},
    "pitch": {**ENCODER, **AXLES},
}
RANGES = {
    ("travel_speed", "rate_hz"): (None, 1e7),
    ("travel_speed", "window_s"): (None, 60.0),
    ("projection", "rate_hz"): (0.0, None),
    ("integral", "step_s"): (0.0, None),
    ("adaptive", "cut_off_every"): (1, 65536),
    ("road_prior", "rate_hz"): (10.0, 1e7),
    ("road_prior", "gravity_mps2"): (-1e6, 1e6),
    ("road_prior", "node_rate_hz"): (10.0, 1000.0),
    ("road_prior", "lag_s"): (None, 3600.0),
    ("road_prior", "tolerance_m"): (0.0, None),
    ("road_prior", "wavelength_m"): (1e-3, 1e6),
    ("road_prior", "acceleration"): (0.0, 1e9),
    ("road_prior", "missing_acceleration"): (0.0, 1e9),
    ("road_prior", "edge_sigmas"): (0.0, 1e9),
    ("road_prior", "acceleration_bias"): (1e-15, 1e6),
    ("road_prior", "reading_m"): (1e-15, 1e6),
    ("road_prior", "road_memory_m"): (32.0, 1e18),
    ("road_prior", "pitch_damping"): (0.0, None),
    ("road_prior", "lean_expected_rad"): (-1e9, 1e9),
    ("iri", "interval_m"): (None, 2.0),
    ("iri", "moving_average_m"): (0.0, None),
    ("causes", "every"): (1, None),
    ("screening", "spread_mps2"): (0.0, None),
    ("screening", "spike"): (0.0, None),
    ("saturation", "hold"): (1.0, 4096.0),
    ("saturation", "quantum"): (0.0, None),
    ("saturation", "farthest"): (1, 1 << 22),
    ("encoder_screening", "usual_m"): (0.0, None),
    ("encoder_screening", "off_m"): (0.0, None),
    ("usual", "longest"): (2, 1 << 20),
    ("kalman_filter", "travel__rate_hz"): (2.0, 1e7),
    ("kalman_filter", "noise__acceleration"): (0.0, 1e9),
    ("kalman_filter", "noise__height_m"): (0.0, 1e9),
    ("kalman_filter", "noise__gnss_height_m"): (1e-9, 1e9),
    ("kalman_filter", "noise__constant_roll"): (1e-9, 1e9),
    ("kalman_filter", "noise__reflection"): (1e-9, 1e9),
    ("kalman_filter", "gravity_mps2"): (-1e9, 1e9),
    ("kalman_filter", "reflection_speed_mps"): (0.0, 10.0),
    ("kalman_filter", "late_s"): (0.0, 60.0),
    ("kalman_filter", "readings"): (1, 100_000),
    ("kalman", "lag_s"): (1.0, 3600.0),
    ("kalman", "fastest_mps"): (0.1, 200.0),
    ("kalman", "gnss_hz"): (0.0, 1000.0),
    ("kalman", "wavelength_m"): (0.025, 1e9),
    ("kalman", "tolerance_m"): (0.0, 1e9),
    ("level_fit", "step_s"): (0.002, 0.06),
    ("level_fit", "front_m"): (-1.4, 98.5),
    ("level_fit", "lever_m"): (-100.0, 100.0),
    ("level_fit", "wavelength_m"): (1.0, 1000.0),
    ("level_fit", "road_m"): (1e-12, 1e6),
    ("level_fit", "lean_sigma_rad"): (1e-12, 1e6),
    ("level_fit", "gain"): (0.0005, 0.02),
    ("level_fit", "lean_rad"): (-1.0, 1.0),
    ("level_fit", "pitch_hz"): (0.01, 100.0),
    ("level_fit", "pitch_damping"): (1e-3, 1.0),
    ("level_fit", "longest_s"): (2.0, 600.0),
    ("level_fit", "most_travel_m"): (1.0, 10_000.0),
    ("level_fit", "most_width"): (16, 512),
    ("level", "rate_hz"): (20.0, 1e6),
    ("level", "metres_per_count"): (None, 10.0),
    ("level", "paths"): (1, 4),
    ("level", "fit__longest_s"): (40.0, 600.0),
    ("level", "fit__most_travel_m"): (200.0, 10_000.0),
    ("pitch", "rate_hz"): (20.0, 1e6),
    ("pitch", "metres_per_count"): (None, 10.0),
    ("pitch", "front_m"): (-1.4, 100.0),
    ("pitch", "lever_m"): (-100.0, 100.0),
    ("pitch", "window_s"): (30.0, 3600.0),
    ("pitch", "shared_s"): (5.0, 600.0),
    ("pitch", "paths"): (1, 4),
}
"""Both ends of ranges that are more than "above zero", None where there is no end, or where another
setting makes it impossible."""


BELOW_ZERO = {"rest_mps2", "gravity_mps2"}
"""Settings with a default above zero that may be below it."""
NOT_READ = {("level", "fit__step_s")}
"""Settings that follow from others, as their comments say."""


def size(library, kind, **settings):
    config = library.config(kind, **{**POSSIBLE[kind], **settings})
    return getattr(library.lib, f"fr_{kind}_size")(config)


def fields(ffi, struct, within=""):
    """Yield the numbers of a struct by their paths, with the names of their types."""
    for name, field in struct.fields:
        if field.type.kind == "struct":
            yield from fields(ffi, field.type, f"{within}{name}__")
        elif field.type.kind == "primitive":
            yield within + name, field.type.cname


def settings_of(library, kind):
    return list(fields(library.ffi, library.ffi.typeof(f"fr_{kind}_config")))


def numbers(library, kind):
    """Return the settings that are no integers and that the library reads."""
    found = [name for name, of in settings_of(library, kind) if of == "double"]
    return [name for name in found if (kind, name) not in NOT_READ]


def beyond(value, away):
    """Return the next number on the side ``away``."""
    return value + away if isinstance(value, int) else np.nextafter(value, away * np.inf)


def test_every_object_is_here():
    assert set(POSSIBLE) == set(KINDS)


@pytest.mark.parametrize("kind", KINDS)
def test_a_number_that_is_not_finite_is_refused(double, kind):
    assert size(double, kind) > 0
    for name in numbers(double, kind):
        for value in (np.nan, np.inf, -np.inf):
            assert size(double, kind, **{name: value}) == 0, (name, value)


@pytest.mark.parametrize("kind", KINDS)
def test_a_number_below_zero_is_refused_unless_the_header_allows_it(double, kind):
    for name in numbers(double, kind):
        config = double.config(kind, **POSSIBLE[kind])
        usual = reduce(getattr, name.split("__"), config)
        if usual > 0.0 and name.split("__")[-1] not in BELOW_ZERO and (kind, name) not in RANGES:
            assert size(double, kind, **{name: -usual}) == 0, name


@pytest.mark.parametrize(("kind", "field"), RANGES)
def test_a_range_has_its_ends_and_nothing_beyond(double, kind, field):
    least, most = RANGES[kind, field]
    for end, away in ((least, -1), (most, 1)):
        if end is not None:
            assert size(double, kind, **{field: end}) > 0, end
            assert size(double, kind, **{field: beyond(end, away)}) == 0, end


def test_what_is_reserved_is_zero(double):
    found = [
        (kind, name)
        for kind in KINDS
        for name, _ in settings_of(double, kind)
        if name.split("__")[-1] == "reserved"
    ]
    assert len(found) >= 9
    for kind, name in found:
        assert size(double, kind, **{name: 0}) > 0
        for value in (1, -1):
            assert size(double, kind, **{name: value}) == 0, (kind, name)


@pytest.mark.parametrize(
    ("longest", "settings"),
    [
        ("interval_m", {"interval_m": 1e6, "metres_per_count": 1e3}),
        ("fastest_mps", {"interval_m": 1e3, "lag_s": 1e3, "fastest_mps": 1e6}),
    ],
)
def test_the_marks_of_a_road_prior_can_be_counted(double, longest, settings):
    assert size(double, "road_prior", **settings) > 0
    for value in (np.nextafter(settings[longest], np.inf), 1e19, 1e25):
        scaled = {**settings, longest: value}
        if longest == "interval_m":
            scaled["metres_per_count"] = value / 1e3
        assert size(double, "road_prior", **scaled) == 0, value


POINT_KINDS = ("projection", "adaptive", "causes", "road_prior", "kalman")


@pytest.mark.parametrize("kind", POINT_KINDS)
def test_the_place_of_every_point_is_a_number(double, kind):
    names = [name for name, _ in settings_of(double, kind)]
    (count_m,) = (name for name in names if name.endswith("metres_per_count"))
    longest = 1.7e308
    assert size(double, kind, **{"interval_m": longest, count_m: longest / 1e3}) == 0
