"""What holds of every object of the C library: splits, copies, and refusals that lose nothing."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

LENGTH, ROOM = 150, 20_000
laws = settings(max_examples=8, deadline=None)
ENCODER = {"metres_per_count": 2.0**-10, "rate_hz": 250.0}
INSIDE = {f"travel__{name}": value for name, value in ENCODER.items()}
REQUIRED = {
    "filter": {"step": 0.004, "cutoff": 0.45},
    "varying": {"step": 0.004},
    "integral": {"step_s": 0.004},
    "travel_speed": ENCODER,
    "projection": {**ENCODER, "interval_m": 0.125},
    "time_step": {"seconds_per_tick": 0.01},
    "adaptive": {**INSIDE, "interval_m": 0.125},
    "high_pass_set": {"step": 0.004, "cutoff": 0.45},
    "adaptive_set": {"rate_hz": 250.0},
    "local_suppression": {"rate_hz": 250.0},
    "matched_high_pass": {"rate_hz": 250.0},
    "iri": {"interval_m": 0.25},
    "screening": ENCODER,
    "level": {**ENCODER, "fit__front_m": 1.5, "fit__rear_m": -1.5},
    "pitch": {**ENCODER, "front_m": 1.5, "rear_m": -1.5},
    "road_prior": {**ENCODER, "interval_m": 0.125},
    "kalman_filter": INSIDE,
    "kalman": {**{f"filter__{name}": value for name, value in INSIDE.items()}, "interval_m": 0.125},
    "causes": {**ENCODER, "interval_m": 0.125},
    "saturation": {"range_least": -40.0, "range_greatest": 40.0},
    "encoder_screening": ENCODER,
}
"""The settings that have no default."""
CALLS = {
    "filter": [("push", "x", 1)],
    "varying": [("push", "xf", 1)],
    "integral": [("push", "x", 1), ("push_steps", "xf", 1), ("push_reflecting", "xxff", 1)],
    "travel_speed": [("push", "n", 1)],
    "projection": [("push", "nx", 1), ("push_timed", "nx", 2)],
    "time_step": [("push", "n", 1)],
    "adaptive": [("push", "xxn", 2)],
    "high_pass_set": [("acceleration", "x", 1), ("height", "x", 1)],
    "adaptive_set": [("acceleration", "xf", 1), ("height", "xf", 1)],
    "local_suppression": [("push", "xf", 1)],
    "matched_high_pass": [("push", "xxf", 1)],
    "iri": [("push", "x", 1)],
}
"""By object: each call, its inputs (x any number, f above zero, n counts), and its outputs."""
EVERY = [(kind, *call) for kind, calls in CALLS.items() for call in calls]
PRECISIONS = pytest.mark.parametrize("precision", ["double", "float"])
OBJECTS = pytest.mark.parametrize(("kind", "call", "inputs", "outputs"), EVERY)
KINDS = pytest.mark.parametrize("kind", REQUIRED)


def drawn(inputs, seed):
    rng = np.random.default_rng(seed)
    make = {
        "x": lambda: rng.normal(size=LENGTH),
        "f": lambda: np.abs(rng.normal(size=LENGTH)) * 9.0,
        "n": lambda: np.cumsum(rng.integers(0, 90, LENGTH)) + 1234,
    }
    return [make[kind]() for kind in inputs]


def run(made, signals, call, outputs, edges):
    found = []
    for begin, end in pairwise(edges):
        part = [x[begin:end] for x in signals]
        status, *results = made.push(*part, call=call, outputs=outputs, capacity=ROOM)
        assert status == 0, made.library.text(status)
        found.append(b"".join(y.tobytes() for y in results) if outputs == 1 else results)
    if outputs == 1:
        return b"".join(found)
    return b"".join(np.concatenate(each).tobytes() for each in zip(*found, strict=True))


@pytest.mark.slow
@PRECISIONS
@OBJECTS
@laws
@given(seed=st.integers(0, 2**32 - 1), cuts=st.lists(st.integers(0, LENGTH), max_size=4))
def test_any_split_gives_the_same_bits(build, precision, kind, call, inputs, outputs, seed, cuts):
    library, signals = build(precision), drawn(inputs, seed)
    signals = [library.array(x) for x in signals]  # One precision rounds before they are split.
    whole = run(library.make(kind, **REQUIRED[kind]), signals, call, outputs, [0, LENGTH])
    edges = [0, *sorted(cuts), LENGTH]
    assert run(library.make(kind, **REQUIRED[kind]), signals, call, outputs, edges) == whole


@PRECISIONS
@OBJECTS
@laws
@given(seed=st.integers(0, 2**32 - 1), cut=st.integers(0, LENGTH))
def test_a_copy_of_the_memory_goes_on_alike(
    build, precision, kind, call, inputs, outputs, seed, cut
):
    library, signals = build(precision), drawn(inputs, seed)
    made = library.make(kind, **REQUIRED[kind])
    run(made, signals, call, outputs, [0, cut])
    copy = made.copy()
    assert copy.pointer != made.pointer
    expected = run(made, signals, call, outputs, [cut, LENGTH])
    made.memory[:] = 0
    assert run(copy, signals, call, outputs, [cut, LENGTH]) == expected


def refused(made, signals, call, outputs, name, **options):
    """Check that a push is refused with status ``name`` and has changed nothing."""
    before = made.memory.copy()
    status, *results = made.push(*signals, call=call, outputs=outputs, **options)
    assert made.library.status[status] == name
    assert (made.memory == before).all()
    assert all(np.isnan(y).all() for y in results)


@PRECISIONS
@OBJECTS
def test_what_is_infinite_or_missing_is_refused_and_changes_nothing(
    build, precision, kind, call, inputs, outputs
):
    made = build(precision).make(kind, **REQUIRED[kind])
    good = drawn(inputs, 1)
    for started in (False, True):
        if started:
            run(made, good, call, outputs, [0, LENGTH // 2])
        for place, letter in enumerate(inputs):
            for value in (np.nan, np.inf, -np.inf) if letter != "n" else (2**51, -(2**60)):
                if (kind, letter, str(value)) == ("projection", "x", "nan"):
                    continue  # A missing sample is a missing point.
                bad = [x[LENGTH // 2 :].copy() for x in good]
                bad[place][7] = value
                refused(made, bad, call, outputs, "FR_BAD_SAMPLE", capacity=ROOM)
    assert run(made, good, call, outputs, [LENGTH // 2, LENGTH])


@KINDS
def test_a_setting_that_is_zero_or_no_number_is_refused(double, kind):
    ffi, out = double.ffi, double.ffi.new(f"fr_{kind} **")
    memory = np.full(1 << 16, 7, np.uint64)
    address = ffi.cast("void *", memory.ctypes.data)
    size, init = getattr(double.lib, f"fr_{kind}_size"), getattr(double.lib, f"fr_{kind}_init")
    bad = [ffi.new(f"fr_{kind}_config *")]
    for name, value in REQUIRED[kind].items():
        bad += [
            double.config(kind, **{**REQUIRED[kind], name: x}) for x in (np.nan, np.inf, -value)
        ]
    if kind != "integral":  # Its step may be 0, for integrals over points.
        bad.append(double.config(kind))
    else:
        bad.pop(0)
    for config in bad:
        assert size(config) == 0
        assert double.status[init(address, memory.nbytes, config, out)] == "FR_BAD_CONFIG"
    assert (memory == 7).all()
    assert out[0] == ffi.NULL


@KINDS
def test_memory_that_cannot_hold_the_object_is_refused(double, kind):
    ffi, init = double.ffi, getattr(double.lib, f"fr_{kind}_init")
    config, out = double.config(kind, **REQUIRED[kind]), double.ffi.new(f"fr_{kind} **")
    size = getattr(double.lib, f"fr_{kind}_size")(config)
    memory = np.full(size + 8, 7, np.uint8)
    address = ffi.cast("char *", memory.ctypes.data)
    refusals = {
        "FR_TOO_SMALL": (address, size - 1, config, out),
        "FR_MISALIGNED": (address + 4, size, config, out),
    }
    for place in (0, 2, 3):
        arguments = [address, size, config, out]
        arguments[place] = ffi.NULL
        assert double.status[init(*arguments)] == "FR_NULL_POINTER"
    for name, arguments in refusals.items():
        assert double.status[init(*arguments)] == name
    assert (memory == 7).all()


@OBJECTS
def test_a_call_that_cannot_be_is_refused_and_changes_nothing(double, kind, call, inputs, outputs):
    made, signals = double.make(kind, **REQUIRED[kind]), drawn(inputs, 2)
    run(made, signals, call, outputs, [0, LENGTH // 2])
    rest = [x[LENGTH // 2 :] for x in signals]
    refused(made, rest, call, outputs, "FR_OUTPUT_FULL", capacity=1)
    needed = made.written
    blank = made.copy()
    blank.memory[:] = 0
    refused(blank, rest, call, outputs, "FR_BAD_OBJECT", capacity=ROOM)
    status, *_ = made.push(*rest, call=call, outputs=outputs, capacity=needed)
    assert status == 0
    assert made.written == needed


@OBJECTS
def test_null_pointers_and_counts_that_ran_over_are_refused(double, kind, call, inputs, outputs):
    made, ffi = double.make(kind, **REQUIRED[kind]), double.ffi
    signals = [double.array(x) for x in drawn(inputs, 2)]
    results, written = [np.empty(ROOM) for _ in range(outputs)], ffi.new("size_t *")
    pointers = [*map(double.at, signals), LENGTH, *map(double.at, results), ROOM, written]
    before = made.memory.copy()
    for place in [k for k, value in enumerate(pointers) if not isinstance(value, int)]:
        arguments = [ffi.NULL if k == place else value for k, value in enumerate(pointers)]
        assert double.status[made.call(call, *arguments)] == "FR_NULL_POINTER"
    pointers[len(signals)] = 2**63
    pointers[-2] = 2**64 - 1
    assert double.status[made.call(call, *pointers)] == "FR_TOO_MANY"
    assert (made.memory == before).all()


def test_every_status_has_a_line_of_its_own(double):
    texts = [double.text(status) for status in double.status]
    assert sorted(double.status) == list(range(len(texts)))
    assert len(set(texts)) == len(texts)
    assert all("\n" not in text and len(text) > 10 for text in texts)
    assert double.text(-1) == double.text(len(texts)) == "this number is no status of the library"


def test_the_builds_do_not_take_each_other_s_objects(double, single):
    made = single.make("filter", **REQUIRED["filter"])
    made.library = double
    memory = np.zeros(100, np.uint64)
    memory[: made.memory.size] = made.memory
    made.memory = memory
    assert double.status[made.push(np.zeros(3))[0]] == "FR_BAD_OBJECT"
    assert (double.lib.fr_real_size(), single.lib.fr_real_size()) == (8, 4)


@pytest.mark.parametrize("kind", ["high_pass_set", "adaptive_set"])
def test_a_set_that_is_not_complete_does_not_end(double, kind):
    made = double.make(kind, **REQUIRED[kind])
    x = [np.ones(9)] if kind == "high_pass_set" else [np.ones(9), np.full(9, 5.0)]
    refused(made, x, "velocity", 1, "FR_WRONG_ORDER")
    assert double.status[made.call("finish")] == "FR_INCOMPLETE_SET"
    for name in ("acceleration", "velocity"):
        made.push(*x, call=name)
    assert double.status[made.call("finish")] == "FR_INCOMPLETE_SET"
    refused(made, x, "reverse", 1, "FR_INCOMPLETE_SET")
    if kind == "adaptive_set":
        made.push(x[0], x[1] + 1.0, call="height")
        refused(made, x, "reverse", 1, "FR_OTHER_SPEED")
        return
    made.push(*x, call="height")
    refused(made, [x[0][:8]], "reverse", 1, "FR_INCOMPLETE_SET")
    assert made.call("finish") == 0
    refused(made, x, "acceleration", 1, "FR_WRONG_ORDER")


def test_counts_that_go_back_and_speeds_that_cannot_be_are_refused(double):
    made = double.make("travel_speed", **ENCODER)
    made.push(np.array([5, 9]))
    refused(made, [np.array([9, 8])], "push", 1, "FR_GOES_BACK")
    whole = double.make("adaptive", **REQUIRED["adaptive"])
    fast = [np.ones(20), np.ones(20), np.arange(20) * 4000 * 1024]
    refused(whole, fast, "push", 2, "FR_BAD_CUTOFF", capacity=10**6)
    leap = [np.array([0, 2**49]), np.ones(2)]
    projection = double.make("projection", **REQUIRED["projection"])
    refused(projection, leap, "push", 1, "FR_BAD_SAMPLE", capacity=ROOM)
