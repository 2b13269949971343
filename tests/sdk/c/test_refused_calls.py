"""What is refused says so, writes nothing, and leaves the object as it was."""

import subprocess

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.c import amalgamation

NO_COUNT = -(2**63)
SMALL_BYTES = 1 << 22
STALE = 77777


def test_nothing_is_written_by_a_refused_call(double):
    ffi, found = double.ffi, 0
    for name in dir(double.lib):
        call = getattr(double.lib, name)
        kinds = ffi.typeof(call).args if name.startswith("fr_") and callable(call) else ()
        if not kinds or kinds[-1].cname != "size_t *":
            continue
        written = ffi.new("size_t *", STALE)
        given = [ffi.NULL if kind.kind == "pointer" else 0 for kind in kinds[:-1]]
        assert double.status[call(*given, written)] != "FR_OK", name
        assert written[0] == 0, name
        found += 1
    assert found > 40


def test_nothing_is_written_after_the_end(double):
    made = double.make("iri", interval_m=0.25)
    made.push(np.zeros(100), capacity=200)
    trace, written = double.at(np.zeros(200)), double.ffi.new("size_t *")
    assert made.call("finish", trace, 200, written) == 0
    status, _ = made.push(np.zeros(10), capacity=200)
    assert (double.status[status], made.written) == ("FR_WRONG_ORDER", 0)


def test_a_state_of_another_version_is_no_object(double):
    made = double.make("travel_speed", rate_hz=100.0, metres_per_count=0.01)
    counts = np.arange(10)
    assert made.copy().push(counts)[0] == 0
    made.memory.view(np.uint16)[2] += 1
    status, _ = made.push(counts)
    assert (double.status[status], made.written) == ("FR_BAD_OBJECT", 0)


@pytest.fixture(scope="module")
def small(double, compiler, tmp_path_factory):
    """Return the size functions of the library on a machine whose objects have 4 MB at most."""
    folder = tmp_path_factory.mktemp("small")
    amalgamation.main([str(folder)])
    command = [compiler, "-std=c99", "-O1", f"-DFR_MOST_BYTES={SMALL_BYTES}u", "-fPIC", "-shared"]
    program = folder / "small.so"
    subprocess.run([*command, "-o", program, folder / "floatref.c", "-lm"], check=True)
    return double.ffi.dlopen(str(program))


LARGE = {
    "road_prior": {"rate_hz": 500.0, "metres_per_count": 0.01, "interval_m": 0.05, "lag_s": 60.0},
    "kalman": {
        "filter__travel__rate_hz": 500.0,
        "filter__travel__metres_per_count": 0.01,
        "interval_m": 0.05,
        "lag_s": 60.0,
    },
    "travel_speed": {"rate_hz": 1000.0, "metres_per_count": 0.01, "window_s": 1.0},
}
RANGES = {"interval_m": (0.002, 1.0), "lag_s": (8.0, 900.0), "window_s": (0.1, 600.0)}


@settings(deadline=None, max_examples=60)
@given(kind=st.sampled_from(sorted(LARGE)), data=st.data())
def test_what_is_too_large_for_a_machine_has_no_size(double, small, kind, data):
    drawn = {
        name: data.draw(st.floats(*RANGES[name]), label=name)
        for name in LARGE[kind]
        if name in RANGES
    }
    config = double.config(kind, **{**LARGE[kind], **drawn})
    here, there = (getattr(lib, f"fr_{kind}_size")(config) for lib in (double.lib, small))
    assert there == (here if here <= SMALL_BYTES else 0)


def test_a_size_beyond_the_machine_is_a_bad_setting(double, small):
    config = double.config("road_prior", **{**LARGE["road_prior"], "lag_s": 900.0})
    out, memory = double.ffi.new("fr_road_prior **"), double.ffi.new("uint64_t[]", 100)
    status = small.fr_road_prior_init(memory, 800, config, out)
    assert double.status[status] == "FR_BAD_CONFIG"


def test_where_nothing_comes_out_no_memory_is_needed(double):
    ffi, lib = double.ffi, double.lib
    written, x = ffi.new("size_t *", STALE), double.at(np.zeros(5))
    iri = double.make("iri", interval_m=0.25)
    assert lib.fr_iri_push(iri.pointer, x, 5, ffi.NULL, 0, written) == 0
    config = double.config("cut_off")
    assert lib.fr_cut_off_frequency(config, ffi.NULL, 0, ffi.NULL, 0, written) == 0
    settings_of = {"travel__rate_hz": 100.0, "travel__metres_per_count": 0.001, "interval_m": 1.0}
    adaptive = double.make("adaptive", **settings_of)
    assert adaptive.push(np.zeros(1), np.zeros(1), np.zeros(1, np.int64), outputs=2)[0] == 0
    counts = double.at(np.arange(1, 6))
    status = lib.fr_adaptive_push(adaptive.pointer, x, x, counts, 5, ffi.NULL, ffi.NULL, 0, written)
    assert (status, written[0]) == (0, 0)


@pytest.mark.parametrize(("bits", "status"), [(64, "FR_OK"), (128, "FR_BAD_SAMPLE")])
def test_a_bit_that_is_no_cause_is_refused_at_once(double, bits, status):
    made = double.make("causes", rate_hz=100.0, metres_per_count=0.01, interval_m=0.5)
    flags, points = np.array([0, bits], np.uint8), np.zeros(9, np.uint8)
    at = [double.ffi.cast("uint8_t *", x.ctypes.data) for x in (flags, points)]
    counts, written = double.at(np.arange(2)), double.ffi.new("size_t *", STALE)
    made_status = made.call("push", counts, at[0], 2, at[1], 9, written)
    assert double.status[made_status] == status
