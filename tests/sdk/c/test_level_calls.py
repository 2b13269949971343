"""Calls of levelling in C that cannot be are refused, and change nothing."""

import numpy as np
import pytest
from tests.sdk.c.level_runs import Run, finish, made_of, push, take
from tests.sdk.c.level_stops import Stop

GOOD = Run(np.full((3000, 2), 9.8), np.full((3000, 2), 0.3), np.arange(3000) * 100)


def refused(made, run, name, part=slice(0, 3000)):
    before = made.memory.copy()
    assert push(made, run, part)[0] == name
    assert (made.memory == before).all()


BAD = [
    ("force", np.nan, "FR_BAD_SAMPLE"),
    ("force", np.inf, "FR_BAD_SAMPLE"),
    ("force", 1e10, "FR_BAD_SAMPLE"),
    ("height", np.nan, "FR_BAD_SAMPLE"),
    ("height", -1e10, "FR_BAD_SAMPLE"),
    ("counts", 2**51, "FR_BAD_SAMPLE"),
    ("counts", 3, "FR_GOES_BACK"),
]


@pytest.mark.parametrize(("name", "value", "status"), BAD)
def test_a_sample_that_cannot_be_is_refused(double, name, value, status):
    made = made_of(double, Stop())
    assert push(made, GOOD, slice(0, 1500))[0] == "FR_OK"
    bad = getattr(GOOD, name).copy()
    bad[2000] = value
    refused(made, GOOD._replace(**{name: bad}), status, slice(1500, 3000))
    assert push(made, GOOD, slice(1500, 3000))[0] == "FR_OK"


def test_counts_may_go_back_where_that_is_taken(double):
    bad = GOOD._replace(counts=GOOD.counts - 150 * (np.arange(3000) // 500))
    refused(made_of(double, Stop()), bad, "FR_GOES_BACK")
    assert push(made_of(double, Stop(), back=1), bad, slice(0, 3000))[0] == "FR_OK"


def test_bins_that_nobody_takes_fill_the_queue(double):
    made, ready = made_of(double, Stop()), 0
    for k in range(8):
        run = GOOD._replace(counts=GOOD.counts + 300_000 * k)
        status, more = push(made, run, slice(0, 3000))
        if status != "FR_OK":
            break
        ready = more
    assert (status, more) == ("FR_OUTPUT_FULL", ready)
    refused(made, run, "FR_OUTPUT_FULL")
    assert len(take(made)) == ready
    assert push(made, run, slice(0, 3000))[0] == "FR_OK"


def test_more_than_20_seconds_at_a_time_are_refused(double):
    long = Run(*(np.concatenate([x, x[-1:].repeat(1001, axis=0)]) for x in GOOD))
    refused(made_of(double, Stop()), long, "FR_TOO_MANY", slice(0, 4001))


def test_after_the_end_only_bins_are_taken(double):
    made = made_of(double, Stop())
    assert push(made, GOOD, slice(0, 3000))[0] == "FR_OK"
    assert len(finish(made)) == 1500
    refused(made, GOOD, "FR_WRONG_ORDER")
    assert double.status[made.call("finish", double.ffi.new("size_t *"))] == "FR_WRONG_ORDER"
    assert take(made) == []


@pytest.mark.parametrize("count", [0, 1, 3, 100, 127, 200])
def test_a_run_of_any_length_ends(double, count):
    """The last bin is left out unless it is complete."""
    made = made_of(double, Stop())
    assert push(made, GOOD, slice(0, count))[0] == "FR_OK"
    assert len(finish(made)) == count // 2


def test_null_pointers_and_other_memory_are_refused(double):
    ffi, made = double.ffi, made_of(double, Stop())
    ready, bins, every = ffi.new("size_t *"), ffi.new("fr_level_bin[]", 4), ffi.new("int64_t *")
    arrays = [double.array(x) for x in GOOD]
    good = [*map(double.at, arrays), 3000, ready]
    for place in (0, 1, 2, 4):
        arguments = [ffi.NULL if k == place else value for k, value in enumerate(good)]
        assert double.status[made.call("push", *arguments)] == "FR_NULL_POINTER"
    assert double.status[made.call("finish", ffi.NULL)] == "FR_NULL_POINTER"
    assert double.status[made.call("take", ffi.NULL, 4, ready)] == "FR_NULL_POINTER"
    assert double.status[made.call("take", bins, 4, ffi.NULL)] == "FR_NULL_POINTER"
    assert double.status[made.call("every", ffi.NULL)] == "FR_NULL_POINTER"
    assert made.call("every", every) == 0
    assert every[0] == 2
    made.memory[0] = 0
    for name, arguments in (("push", good), ("take", (bins, 4, ready)), ("every", (every,))):
        assert double.status[made.call(name, *arguments)] == "FR_BAD_OBJECT"


SETTINGS = {
    "rate_hz": (0.0, 19.0, 2e6, np.nan, np.inf),
    "metres_per_count": (0.0, -1.0, 11.0, np.nan),
    "paths": (0, 5, -1),
    "back": (2, -1),
    "missing": (2, -1),
    "fit__longest_s": (39.0, 601.0, np.nan),
    "fit__most_travel_m": (199.0, 2e4, np.nan),
    "fit__front_m": (np.nan, -9.0),
    "fit__most_width": (8, 1000),
}


@pytest.mark.parametrize("name", SETTINGS)
def test_a_setting_out_of_its_range_is_refused(double, name):
    good = {"rate_hz": 200.0, "metres_per_count": 0.01, "fit__front_m": 4.0, "fit__rear_m": 1.0}
    assert double.lib.fr_level_size(double.config("level", **good)) > 0
    for value in SETTINGS[name]:
        config = double.config("level", **{**good, name: value})
        assert double.lib.fr_level_size(config) == 0
