"""Calls of the modelled pitch in C that cannot be are refused, and change nothing."""

import numpy as np
import pytest
from tests.sdk.c.level_runs import Run, push
from tests.sdk.c.level_stops import Stop
from tests.sdk.c.pitch_runs import finish, made_of, take

GOOD = Run(np.full((4000, 2), 9.8), np.full((4000, 2), 0.3), np.arange(4000) * 100)
SHORT = {"window_s": 10.0, "shared_s": 5.0}
BAD = [
    ("force", np.nan, "FR_BAD_SAMPLE"),
    ("force", np.inf, "FR_BAD_SAMPLE"),
    ("force", 1e10, "FR_BAD_SAMPLE"),
    ("height", np.nan, "FR_BAD_SAMPLE"),
    ("height", -1e10, "FR_BAD_SAMPLE"),
    ("counts", 2**51, "FR_BAD_SAMPLE"),
    ("counts", 3, "FR_GOES_BACK"),
]


def refused(made, run, name, part=slice(0, 4000)):
    before = made.memory.copy()
    status, ready = push(made, run, part)
    assert status == name
    assert (made.memory == before).all()
    return ready


@pytest.mark.parametrize(("name", "value", "status"), BAD)
def test_a_sample_that_cannot_be_is_refused(double, name, value, status):
    made = made_of(double, Stop())
    assert push(made, GOOD, slice(0, 1500))[0] == "FR_OK"
    bad = getattr(GOOD, name).copy()
    bad[2000] = value
    refused(made, GOOD._replace(**{name: bad}), status, slice(1500, 3000))
    assert push(made, GOOD, slice(1500, 3000))[0] == "FR_OK"


def test_counts_may_go_back_where_that_is_taken(double):
    bad = GOOD._replace(counts=GOOD.counts - 150 * (np.arange(4000) // 500))
    refused(made_of(double, Stop()), bad, "FR_GOES_BACK")
    assert push(made_of(double, Stop(), back=1), bad, slice(0, 4000))[0] == "FR_OK"


def test_a_window_that_is_not_taken_stops_the_next_one_and_the_end(double):
    made = made_of(double, Stop(), **SHORT)
    assert push(made, GOOD, slice(0, 2000)) == ("FR_OK", 0)
    assert push(made, GOOD, slice(2000, 4000)) == ("FR_OK", 1000)
    later = GOOD._replace(counts=GOOD.counts + 400_000)
    assert push(made, later, slice(0, 900)) == ("FR_OK", 1000)
    assert refused(made, later, "FR_OUTPUT_FULL", slice(900, 2000)) == 1000
    ready = double.ffi.new("size_t *")
    assert double.status[made.call("finish", ready)] == "FR_OUTPUT_FULL"
    assert ready[0] == 1000
    assert take(made).size == 1000
    assert push(made, later, slice(900, 2000)) == ("FR_OK", 1000)


def test_more_than_a_window_at_a_time_is_refused(double):
    refused(made_of(double, Stop(), **SHORT), GOOD, "FR_TOO_MANY", slice(0, 2001))


def test_after_the_end_only_bins_are_taken(double):
    made = made_of(double, Stop())
    assert push(made, GOOD, slice(0, 3000))[0] == "FR_OK"
    assert finish(made).size == 1500
    refused(made, GOOD, "FR_WRONG_ORDER")
    assert double.status[made.call("finish", double.ffi.new("size_t *"))] == "FR_WRONG_ORDER"
    assert take(made).size == 0


def test_null_pointers_and_other_memory_are_refused(double):
    ffi, made = double.ffi, made_of(double, Stop())
    ready, sines, every = ffi.new("size_t *"), ffi.new("double[]", 4), ffi.new("int64_t *")
    arrays = [double.array(x) for x in GOOD]
    good = [*map(double.at, arrays), 4000, ready]
    for place in (0, 1, 2, 4):
        arguments = [ffi.NULL if k == place else value for k, value in enumerate(good)]
        assert double.status[made.call("push", *arguments)] == "FR_NULL_POINTER"
    assert double.status[made.call("finish", ffi.NULL)] == "FR_NULL_POINTER"
    assert double.status[made.call("take", ffi.NULL, 4, ready)] == "FR_NULL_POINTER"
    assert double.status[made.call("take", sines, 4, ffi.NULL)] == "FR_NULL_POINTER"
    assert double.status[made.call("every", ffi.NULL)] == "FR_NULL_POINTER"
    assert made.call("every", every) == 0
    assert every[0] == 2
    made.memory[0] = 0
    for name, arguments in (("push", good), ("take", (sines, 4, ready)), ("every", (every,))):
        assert double.status[made.call(name, *arguments)] == "FR_BAD_OBJECT"


SETTINGS = {
    "rate_hz": (0.0, 19.0, 2e6, np.nan, np.inf),
    "metres_per_count": (0.0, -1.0, 11.0, np.nan),
    "paths": (0, 5, -1),
    "back": (2, -1),
    "missing": (2, -1),
    "front_m": (np.nan, 1.05, 101.0),
    "rear_m": (np.nan, 3.95, -101.0),
    "lever_m": (np.nan, 101.0, -np.inf),
    "window_s": (np.nan, 29.0, 3601.0),
    "shared_s": (np.nan, 4.0, 601.0),
}


@pytest.mark.parametrize("name", SETTINGS)
def test_a_setting_out_of_its_range_is_refused(double, name):
    good = {"rate_hz": 200.0, "metres_per_count": 0.01, "front_m": 4.0, "rear_m": 1.0}
    assert double.lib.fr_pitch_size(double.config("pitch", **good)) > 0
    for value in SETTINGS[name]:
        config = double.config("pitch", **{**good, name: value})
        assert double.lib.fr_pitch_size(config) == 0


@pytest.mark.parametrize("wheelbase_m", [0.1, 1.0, 8.0, 100.0])
@pytest.mark.parametrize("rate", [20.0, 149.0, 16_000.0])
def test_every_possible_vehicle_has_a_pitch_that_is_a_number(double, wheelbase_m, rate):
    rng = np.random.default_rng(0)
    noise = rng.normal(size=(2, 4000, 2)) * [[[0.3]], [[0.01]]]
    stop = Stop(wheelbase_m=wheelbase_m, front_m=0.5 * wheelbase_m, lever_m=0.5)
    run = Run(9.8 + noise[0], 0.3 + noise[1], np.arange(4000) * 4096)
    made = made_of(double, stop, rate)
    for begin in range(0, 4000, 80):
        assert push(made, run, slice(begin, begin + 80))[0] == "FR_OK"
    assert np.isfinite(finish(made)).all()
