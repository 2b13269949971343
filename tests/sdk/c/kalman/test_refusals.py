"""Readings, samples and settings that the Kalman objects refuse, without any change."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.estimators.kalman import Plan

KINDS = pytest.mark.parametrize("kind", ["kalman_filter", "kalman"])
GOOD = (313.0, 0.1, 0.01, 0.01)
OUTPUTS = {"kalman_filter": ("double *",), "kalman": ("fr_real *", "fr_real *", "uint8_t *")}


def settings_for(kind, **settings):
    """Return settings by their names in either object."""
    if kind == "kalman_filter":
        return settings
    inside = {f"filter__{name}": value for name, value in settings.items()}
    return {"interval_m": 0.25, "lag_s": 2.0, **inside}


@pytest.fixture
def made_of(drive, path_of):
    """Return a function that makes an object, and one that pushes samples into it."""
    drawn = drive(1, 12.0)

    def make(kind, plan=None, **settings):
        path = path_of(kind, drawn, plan, **settings_for(kind, **settings))

        def push(begin, end, other=drawn, room=10_000):
            outputs = [(name, np.full(10_000, 7.0)) for name in OUTPUTS[kind]]
            status, written = path.push(other, begin, end, outputs, room)
            if status:
                assert all((y == 7.0).all() for _, y in outputs)
            return path.library.status[status], written

        return path, push, drawn

    return make


def refuses(path, name, sample, values=GOOD, variances=None):
    before = path.made.memory.copy()
    assert path.library.status[path.read(sample, values, variances)] == name
    assert (path.made.memory == before).all()


@KINDS
def test_readings_that_cannot_be_taken_have_a_status(made_of, kind):
    path, push, _ = made_of(kind, late_s=0.25, readings=3)
    assert push(0, 200)[0] == "FR_OK"
    first = 200 - 64  # the first sample that still waits, at 256 Hz
    refuses(path, "FR_TOO_LATE", first - 1)
    assert path.read(first, GOOD) == 0
    refuses(path, "FR_TOO_LATE", first)
    for values in ((np.nan, 0, 0, 0), (np.inf, 0, 0, 0), (313, -np.inf, 0, 0), (1e12, 0, 0, 0)):
        refuses(path, "FR_BAD_SAMPLE", 190, values)
    for variance in (0.0, -1.0, np.inf):
        refuses(path, "FR_BAD_SAMPLE", 190, GOOD, [1e-4, variance, 1e-4, 1e-4])
    refuses(path, "FR_BAD_SAMPLE", -1)
    refuses(path, "FR_BAD_SAMPLE", 2**60)
    assert path.read(150, (313.0, np.nan, np.nan, np.nan)) == path.read(400, GOOD) == 0
    refuses(path, "FR_QUEUE_FULL", 500)
    assert push(200, 600)[0] == "FR_OK"
    assert path.read(601, GOOD) == 0


@KINDS
def test_without_gnss_a_reading_is_out_of_order(made_of, kind):
    path, _, _ = made_of(kind, Plan(gnss=False, attitude=False))
    refuses(path, "FR_WRONG_ORDER", 3)


@KINDS
def test_samples_that_are_missing_or_wrong_are_refused(made_of, kind):
    path, push, drawn = made_of(kind)
    assert push(0, 1000)[0] == "FR_OK"
    before = path.made.memory.copy()
    for column in range(6):
        for value in (np.nan, np.inf, 1e12):
            u = drawn.u.copy()
            u[1500, column] = value
            assert push(1000, 2000, replace(drawn, u=u))[0] == "FR_BAD_SAMPLE"
    height, counts = drawn.height.copy(), drawn.counts.copy()
    height[1500], counts[1500] = np.nan, counts[1499] - 1
    assert push(1000, 2000, replace(drawn, height=height))[0] == "FR_BAD_SAMPLE"
    assert push(1000, 2000, replace(drawn, counts=counts))[0] == "FR_GOES_BACK"
    assert (path.made.memory == before).all()
    assert push(1000, 2000)[0] == "FR_OK"


@pytest.mark.parametrize("late_s", [0.0, 0.5])
def test_an_encoder_that_leaps_over_more_than_is_held_is_refused(made_of, late_s):
    path, push, drawn = made_of("kalman", late_s=late_s)
    assert push(0, 50)[0] == "FR_OK"
    before = path.made.memory.copy()
    for leap in (10**6, 2**45):
        counts = drawn.counts + leap * (np.arange(len(drawn)) > 60)
        assert push(50, 400, replace(drawn, counts=counts))[0] == "FR_BAD_SAMPLE"
    assert (path.made.memory == before).all()
    assert push(50, 400)[0] == "FR_OK"


@KINDS
def test_without_room_nothing_is_lost(made_of, kind):
    path, push, _ = made_of(kind)
    before = path.made.memory.copy()
    status, needed = push(0, 3000, room=3)
    assert status == "FR_OUTPUT_FULL"
    assert (path.made.memory == before).all()
    assert push(0, 3000, room=needed) == ("FR_OK", needed)


@KINDS
def test_a_copy_of_the_memory_goes_on_alike(made_of, kind):
    path, push, drawn = made_of(kind, late_s=0.1)
    for k in range(20):
        assert path.read(drawn.at[k], drawn.y[k]) == 0
    assert push(0, 1500)[0] == "FR_OK"
    kept, outputs = path.made.memory.copy(), []
    for memory in (path.made.memory, kept):
        path.made.memory = memory
        made = [(name, np.full(10_000, 7.0)) for name in OUTPUTS[kind]]
        assert path.push(drawn, 1500, 3000, made, 10_000)[0] == 0
        outputs.append([y.tobytes() for _, y in made])
    assert outputs[0] == outputs[1]


@KINDS
def test_at_the_end_the_run_is_over(made_of, kind):
    path, push, _ = made_of(kind)
    assert push(0, 600)[0] == "FR_OK"
    written = path.ffi.new("size_t *")
    keep = [np.empty(9000) for _ in OUTPUTS[kind]]
    room = [path.ffi.cast(n, y.ctypes.data) for n, y in zip(OUTPUTS[kind], keep, strict=True)]
    assert path.made.call("finish", *room, 9000, written) == 0
    assert path.library.status[path.made.call("finish", *room, 9000, written)] == "FR_WRONG_ORDER"
    refuses(path, "FR_WRONG_ORDER", 700)
    assert push(600, 700)[0] == "FR_WRONG_ORDER"
    count = path.ffi.new("int64_t[4]")
    assert path.made.call("left_out", count) == 0
    assert list(count) == [0, 0, 0, 0]
    assert path.library.status[path.made.call("left_out", path.ffi.NULL)] == "FR_NULL_POINTER"


@KINDS
def test_a_run_without_samples_ends(made_of, kind):
    path, _, _ = made_of(kind, late_s=0.1)
    written, nothing = path.ffi.new("size_t *", 7), [path.ffi.NULL] * len(OUTPUTS[kind])
    assert path.made.call("finish", *nothing, 0, written) == 0
    assert written[0] == 0
