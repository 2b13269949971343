"""Golden vectors through the C library, in double and in float, each at the tolerance it states."""

import numpy as np
import pytest

from floatref_conformance import golden

ORDER = {"b3s1": 1, "b3s2": 2, "b3s1r": 1, "b3s2r": 2}
ELSEWHERE = {
    "cross-correlation": "compares two finished profiles",
    "high-pass": "filters a finished profile for a display",
    "validity": "is for the part that firmware knows of its sensors",
}
"""Vectors of what the library has not, and why."""
MICROMETRE = 1e-6
"""The distances of the vectors are written to this, so they are whole counts of it."""


def counts(metres):
    return np.rint(np.asarray(metres) / MICROMETRE).astype(np.int64)


def section(library, stage, s, i):
    kind, name, *form = stage.split("-")
    direction = 2 if name.endswith("r") else 1
    if form:
        settings = {"step": s["step"], "form": int(form[0] == "state")}
        made = library.make("varying", sections=ORDER[name], direction=direction, **settings)
        return {"y": made.push(i["x"], i["cutoff"])[1]}
    passes = {"hpf": 1, "lpf": 2}[kind]
    made = library.make("filter", order=ORDER[name], passes=passes, direction=direction, **s)
    return {"y": made.push(i["x"])[1]}


def integral(library, s, i):
    made = library.make("integral", step_s=s["step"], start=s["start"])
    return {"y": made.push(i["x"])[1]}


def travel_speed(library, s, i):
    made = library.make("travel_speed", metres_per_count=MICROMETRE, **s)
    return {"speed": made.push(counts(i["distance"]))[1]}


def cut_off(library, s, i):
    interval_m, steepness = s.pop("interval_m"), s.pop("steepness")
    config = library.config("cut_off", steepness_s_per_m=steepness, **s)
    speed = library.array(i["speed"])
    frequency = library.array_call("fr_cut_off_frequency", config, speed)[1]
    wave_number, written = np.empty_like(speed), library.ffi.new("size_t *")
    arguments = interval_m, library.at(speed), speed.size, library.at(wave_number), speed.size
    assert library.lib.fr_cut_off_wave_number(config, *arguments, written) == 0
    return {"frequency": frequency, "wave_number": wave_number}


def suppressed(library, s, i):
    return {"y": library.make("local_suppression", **s).push(i["x"], i["speed"])[1]}


def projected(library, s, i):
    made = library.make("projection", metres_per_count=MICROMETRE, **s)
    return {"y": made.push(counts(i["distance"]), i["x"], capacity=999)[1]}


def time_step(library, s, i):
    ticks = np.rint(np.asarray(i["time"]) * 100).astype(np.int64)
    return {"time_step": library.make("time_step", seconds_per_tick=0.01).push(ticks)[1]}


def distorted(library, s, i):
    config = library.config("timer_distortion", **s)
    return {"adjusted": library.array_call("fr_timer_distortion_steps", config, i["time_step"])[1]}


def over_points(library, s, i):
    made = library.make("integral")
    return {"y": made.push(i["x"], i["time_step"], call="push_steps")[1]}


def reflected(library, s, i):
    signals = i["velocity"], i["height"], i["adjusted"], i["time_step"]
    return {"reference_height": library.make("integral").push(*signals, call="push_reflecting")[1]}


def observed(library, s, i):
    made = library.make("matched_high_pass", **s)
    _, reference = made.push(i["acceleration"], i["height"], i["cutoff"])
    return {"elevation": reference - library.array(i["height"])}


def temporal(library, s, i):
    encoder = {"travel__rate_hz": s["rate_hz"], "travel__metres_per_count": MICROMETRE}
    made = library.make("adaptive", interval_m=s["interval_m"], **encoder)
    signals = i["acceleration"], i["height"], counts(i["distance"])
    _, *points = made.push(*signals, outputs=2, capacity=999)
    return {"elevation": made.push(*points, call="finish")[1]}


def spatial(library, s, i):
    """5.10: force and height at the points, timer distortion, the set, reflection, backward."""
    steps, signals = None, {}
    for name in ("acceleration", "height"):
        made = library.make("projection", metres_per_count=MICROMETRE, **s)
        where = counts(i["distance"])
        call = {"call": "push_timed", "outputs": 2, "capacity": 999}
        _, signals[name], steps = made.push(where, i[name], **call)
    limit = library.config("timer_distortion", interval_m=s["interval_m"])
    adjusted = library.array_call("fr_timer_distortion_steps", limit, steps)[1]
    filters = library.make("high_pass_set", step=s["interval_m"], cutoff=1.0 / 105.91)
    a = filters.push(signals["acceleration"], call="acceleration")[1]
    v = library.make("integral").push(a, adjusted, call="push_steps")[1]
    v = filters.push(v, call="velocity")[1]
    h = filters.push(signals["height"], call="height")[1]
    r = library.make("integral").push(v, h, adjusted, steps, call="push_reflecting")[1]
    return {"elevation": filters.push(r - h, call="reverse")[1]}


def smoothed(library, s, i):
    """The road prior with a lag longer than the run, so that all points come at the end."""
    made = library.make("road_prior", metres_per_count=MICROMETRE, **s)
    flags, written = np.empty(999, np.uint8), library.ffi.new("size_t *")
    where, elevation, sigma = counts(i["distance"]), *np.empty((2, 999), library.dtype)
    inputs = [library.array(x) for x in (i["acceleration"], i["height"], where)]
    outputs = library.at(elevation), library.at(sigma), library.ffi.from_buffer("uint8_t[]", flags)
    assert made.call("push", *map(library.at, inputs), where.size, *outputs, 999, written) == 0
    assert made.call("finish", *outputs, 999, written) == 0
    return {"elevation": elevation[: written[0]]}


def smoothed_by_kalman(library, s, i):
    """As above; states and inputs are double in both builds."""
    names = "gnss_height", "gnss_velocity", "gnss_pitch", "gnss_roll"
    travel = {"rate_hz": s.pop("rate_hz"), "metres_per_count": MICROMETRE}
    inside = {f"filter__travel__{name}": x for name, x in travel.items()}
    inside["filter__antenna_m"] = [s.pop(f"arm_{axis}") for axis in "xyz"]
    interval_m, more = s.pop("interval_m"), {"filter__readings": 999, "filter__reflects": 0}
    noise = {f"filter__noise__{name}": x for name, x in s.items()}
    noise |= {"filter__noise__lean_rad": 0.0, "filter__noise__gnss_height_walk": 0.0}
    made = library.make("kalman", interval_m=interval_m, **inside, **noise, **more)
    for at, *y in zip(i["gnss_at"], *(i[name] for name in names), strict=True):
        values = library.ffi.new("double[4]", y)
        assert made.call("push_gnss", int(at), values, library.ffi.NULL) == 0
    doubles = {name: np.ascontiguousarray(x, float) for name, x in i.items()}
    at = {name: library.ffi.cast("double *", x.ctypes.data) for name, x in doubles.items()}
    axes = "longitudinal", "lateral", "vertical", "roll_rate", "pitch_rate", "yaw_rate"
    imu = library.ffi.new("fr_imu *", [at[name] for name in axes])
    flags, written = np.empty(999, np.uint8), library.ffi.new("size_t *")
    where, elevation, sigma = counts(i["distance"]), *np.empty((2, 999), library.dtype)
    outputs = library.at(elevation), library.at(sigma), library.ffi.from_buffer("uint8_t[]", flags)
    inputs = imu, at["height"], library.at(where), where.size
    assert made.call("push", *inputs, *outputs, 999, written) == 0
    assert made.call("finish", *outputs, 999, written) == 0
    return {"elevation": elevation[: written[0]]}


def roughness(library, s, i):
    made = library.make("iri", **s)
    _, trace = made.push(i["elevation"])
    rest, written = np.empty(999, library.dtype), library.ffi.new("size_t *")
    assert made.call("finish", library.at(rest), 999, written) == 0
    value = library.ffi.new("fr_real *")
    assert made.call("value", value) == 0
    return {"trace": np.append(trace, rest[: written[0]]), "iri": [value[0]]}


STAGES = {
    "trapezoidal-rule": integral,
    "travel-speed": travel_speed,
    "adaptive-cut-off": cut_off,
    "local-suppression": suppressed,
    "projection": projected,
    "time-step": time_step,
    "timer-distortion": distorted,
    "spatial-integration": over_points,
    "reflection": reflected,
    "matched-high-pass": observed,
    "road-prior-smoother": smoothed,
    "kalman-smoother": smoothed_by_kalman,
    "adaptive-hpf-spatial-backward": temporal,
    "timer-distortion-reflection": spatial,
    "iri": roughness,
}


@pytest.mark.parametrize("name", [n for n in golden.names() if n not in ELSEWHERE])
@pytest.mark.parametrize("precision", ["double", "float"])
def test_the_library_makes_of_a_vector_what_the_reference_makes(build, precision, name):
    library, vector = build(precision), golden.read(name)
    stage, settings = vector["stage"], dict(vector["settings"])
    inputs = {key: np.array(x, float) for key, x in vector["inputs"].items()}
    if stage in STAGES:
        made = STAGES[stage](library, settings, inputs)
    else:
        made = section(library, stage, settings, inputs)
    assert made.keys() == vector["outputs"].keys()
    tolerance = vector["tolerance"]["float64" if precision == "double" else "float32"]
    for key, expected in vector["outputs"].items():
        allowed = tolerance * np.abs(expected).max()
        np.testing.assert_allclose(made[key], expected, rtol=0, atol=allowed, err_msg=key)


def test_what_has_no_counterpart_is_still_a_vector():
    assert set(ELSEWHERE) <= set(golden.names())
