"""The fit of a stretch in C is that of the SDK, and nothing of it is silent."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from tests.sdk.c.level_stops import (
    STOPS,
    Stop,
    bins_of,
    config_of,
    drive_of,
    fit_in_c,
    stretch_of,
)

from floatref.estimators.road_slope.gauss_newton import SETTLED_RAD, fit
from floatref.estimators.road_slope.layout import GLOBALS
from floatref.estimators.road_slope.levelled import UNKNOWN_M, _sigma, is_believed
from floatref.estimators.road_slope.stretches import find_stretches

few = settings(deadline=None, max_examples=12)
ANSWER = 0.01
"""Of a 1-σ: less than anybody measures. The SDK corrects the solution of a pass once, C twice; that
leaves a thousandth of a 1-σ of a large step, which some passes carry on."""
VARIANCE = 0.05
"""Of itself, which is 2.5 % of a 1-σ. A covariance is not corrected: by a normal matrix of the
condition 1e14 it is right within some hundredths, see `Factors.solve`."""
FOUND, TOO_SHORT, TOO_LONG, UNSETTLED, UNLIKELY = range(5)


def fitted(library, stop, **set_to):
    """Return drive, pieces, the configuration, and the fit in C of the one stretch of a stop."""
    drive, config = drive_of(stop), config_of(library, stop, **set_to)
    (pieces,) = find_stretches(drive)
    bins, arrays = bins_of(library, drive, pieces)
    return drive, pieces, config, (fit_in_c(library, config, bins), arrays["number"])


def assert_same_numbers(expected, found, numbers):
    """Compare pitch, vehicle and grade in parts of their 1-σ."""
    stretch, y = expected.stretch, expected.unknowns
    layout, nodes = stretch.layout, stretch.readings.bins
    places = [layout.place(name) for name in GLOBALS]
    weights = np.eye(layout.size)[[*places, *range(layout.pitch.start, layout.pitch.stop, 20)]]
    weights = np.vstack([weights, np.zeros(layout.size)])
    weights[-1, layout.slope] = 1.0 / layout.points
    sigma = np.sqrt(np.diag(expected.covariance(weights)))
    vehicle = np.array(list(found.result.vehicle)) - y[places]
    np.testing.assert_allclose(vehicle / sigma[: len(places)], 0.0, atol=ANSWER)
    off = found.pitch - np.interp(numbers, nodes, y[layout.pitch])
    assert np.abs(off).max() <= ANSWER * sigma[len(places) : -1].max()
    assert abs(found.result.grade - expected.grade) <= ANSWER * sigma[-1]


@pytest.mark.slow
@few
@given(stop=STOPS)
@example(stop=Stop())
@example(stop=Stop(stood_s=0.5, lever_m=0.3, missing=0.05, unread=0.2))
def test_a_stretch_has_the_fit_of_the_sdk(double, stop):
    drive, pieces, config, (found, numbers) = fitted(double, stop)
    assert found.status == "FR_OK"
    expected = fit(stretch_of(config, drive, pieces))
    # Passes end by a change next to the bound, and rounding decides after how many they do.
    ends = expected.changed_rad, found.result.changed_rad
    assume(min(abs(change / SETTLED_RAD - 1) for change in ends) > 0.02)
    assert (found.result.outcome == FOUND) == is_believed(expected)
    assume(expected.changed_rad < SETTLED_RAD and is_believed(expected))
    assert found.result.passes == expected.passes
    assert_same_numbers(expected, found, numbers)
    np.testing.assert_allclose(found.result.prior_misfit, expected.prior_misfit, rtol=1e-2)
    inside = slice(pieces[0].start, pieces[-1].stop)
    sigma = _sigma(expected, drive.distance[inside], config.wavelength_m)
    ours = np.square(found.sigma_m / sigma[numbers - inside.start])
    np.testing.assert_allclose(ours, 1.0, rtol=VARIANCE)


@pytest.mark.slow
@settings(deadline=None, max_examples=4)
@given(dirt=st.integers(0, 2**64 - 1), offset=st.integers(0, 3))
def test_memory_keeps_nothing_from_call_to_call(double, single, dirt, offset):
    stop = Stop(speed_mps=8.0)
    drive = drive_of(stop)
    (pieces,) = find_stretches(drive)
    outcomes = []
    for library, how in ((double, {}), (double, {"dirt": dirt, "offset": offset}), (single, {})):
        bins, arrays = bins_of(library, drive, pieces)
        found = fit_in_c(library, config_of(library, stop), bins, **how)
        outcomes.append((found.pitch.tobytes(), found.sigma_m.tobytes(), arrays["number"].size))
    assert outcomes[0] == outcomes[1] == outcomes[2]


def assert_not_levelled(found, outcome):
    assert (found.status, found.result.outcome) == ("FR_OK", outcome)
    assert not found.pitch.any()
    assert (found.sigma_m == UNKNOWN_M).all()


LIMITS = [{"longest_s": 20.0}, {"most_travel_m": 100.0}, {"most_width": 40}]


@pytest.mark.parametrize("limit", LIMITS, ids=lambda limit: next(iter(limit)))
def test_what_has_no_room_is_not_levelled_and_says_so(double, limit):
    assert fitted(double, Stop())[-1][0].result.outcome == FOUND
    assert_not_levelled(fitted(double, Stop(), **limit)[-1][0], TOO_LONG)


@pytest.mark.parametrize("count", [0, 1, 11, 49])
def test_pieces_without_three_nodes_are_too_short(double, count):
    drive, config = drive_of(Stop()), config_of(double, Stop())
    bins, _arrays = bins_of(double, drive, [slice(900, 900 + count)])
    assert_not_levelled(fit_in_c(double, config, bins), TOO_SHORT)


@pytest.mark.slow
def test_a_body_that_something_else_moves_is_not_levelled(double):
    drive, config = drive_of(Stop()), config_of(double, Stop())
    (pieces,) = find_stretches(drive)
    swing = 0.5 * np.sin(2 * np.pi * 0.4 * drive.step * np.arange(drive.force.size))
    moved = drive._replace(force=drive.force + swing)
    bins, _arrays = bins_of(double, moved, pieces)
    found = fit_in_c(double, config, bins)
    assert not is_believed(fit(stretch_of(config, moved, pieces)))
    assert found.result.outcome in (UNSETTLED, UNLIKELY)
    assert_not_levelled(found, found.result.outcome)


BAD = [
    ("force", np.nan, "FR_BAD_SAMPLE"),
    ("height", np.inf, "FR_BAD_SAMPLE"),
    ("missing", 1.5, "FR_BAD_SAMPLE"),
    ("missing", np.nan, "FR_BAD_SAMPLE"),
    ("speed", 1e300, "FR_BAD_SAMPLE"),
    ("along", np.nan, "FR_BAD_SAMPLE"),
    ("distance", np.nan, "FR_BAD_SAMPLE"),
    ("distance", -5.0, "FR_GOES_BACK"),
    ("number", 3, "FR_WRONG_ORDER"),
    ("number", 2**60, "FR_BAD_SAMPLE"),
]


@pytest.mark.parametrize(("name", "value", "status"), BAD)
def test_a_bin_that_cannot_be_is_refused_and_changes_nothing(double, name, value, status):
    config = config_of(double, Stop())
    bins, arrays = bins_of(double, drive_of(Stop()), [slice(700, 1000)])
    arrays[name][150] = value
    found = fit_in_c(double, config, bins, dirt=7)
    assert found.status == status
    assert np.isnan([found.pitch, found.sigma_m]).all()
    assert (found.memory == 7).all()


def test_null_pointers_and_memory_that_cannot_hold_a_fit_are_refused(double):
    ffi, config = double.ffi, config_of(double, Stop())
    bins, _arrays = bins_of(double, drive_of(Stop()), [slice(700, 1000)])
    size = double.lib.fr_level_fit_size(config)
    memory = np.full(size // 8 + 1, 7, np.uint64)
    address, written = ffi.cast("char *", memory.ctypes.data), ffi.new("size_t *")
    result, room = ffi.new("fr_level_result *"), np.full((2, 300), np.nan)
    out = [ffi.cast("double *", each.ctypes.data) for each in room]
    good = [config, address, size, bins, result, *out, 300, written]
    for place in (0, 1, 3, 4, 5, 6, 8):
        arguments = [ffi.NULL if k == place else value for k, value in enumerate(good)]
        assert double.status[double.lib.fr_level_fit(*arguments)] == "FR_NULL_POINTER"
    changed = {1: (address + 4, "FR_MISALIGNED"), 2: (size - 1, "FR_TOO_SMALL")}
    for place, (value, name) in {**changed, 7: (299, "FR_OUTPUT_FULL")}.items():
        arguments = [value if k == place else each for k, each in enumerate(good)]
        assert double.status[double.lib.fr_level_fit(*arguments)] == name
    assert written[0] == 300
    assert (memory == 7).all()


def config_fields(library):
    return [name for name, _ in library.ffi.typeof("fr_level_fit_config").fields]


def test_a_setting_out_of_its_range_is_refused(double):
    bad = [double.ffi.new("fr_level_fit_config *"), double.config("level_fit")]
    for name in set(config_fields(double)) - {"most_width", "reserved"}:
        bad += [config_of(double, Stop(), **{name: x}) for x in (np.nan, np.inf, -1e9, 1e9)]
    bad += [config_of(double, Stop(), most_width=x) for x in (0, -8, 513, 2**31 - 1)]
    assert not any(double.lib.fr_level_fit_size(config) for config in bad)


def test_memory_grows_with_time_road_and_width_as_the_page_says(double):
    """So that a caller can reckon it before there is a library."""
    for s, m, w in ((60.0, 600.0, 80), (120.0, 1500.0, 96), (300.0, 4000.0, 128)):
        limits = {"longest_s": s, "most_travel_m": m, "most_width": w}
        size = double.lib.fr_level_fit_size(config_of(double, Stop(), **limits))
        kilobytes = (47.0 + 0.93 * w) * s + (1.6 + 0.065 * w) * m
        assert size / 1e3 == pytest.approx(kilobytes, rel=0.1)
