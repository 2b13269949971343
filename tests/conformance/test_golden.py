"""Golden vectors: the SDK makes of every input what the reference does, and none has rotted."""

import importlib
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref.engine.validity_and_sigma import Reach, replace_by_validity
from floatref.errors import InputError
from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.measures import cross_correlation, high_pass, iri, iri_trace
from floatref.stages.filters import butterworth, varying
from floatref.stages.filters.matched_high_pass import MatchedHighPass
from floatref.stages.filters.schedule import AdaptiveCutOff
from floatref.stages.integration import Integrate
from floatref.stages.resampling import TimeStep, ToDistance
from floatref.stages.signals import (
    ACCELERATION,
    CUTOFF,
    DISTANCE,
    ELEVATION,
    HEIGHT,
    REFERENCE_HEIGHT,
    TIME,
    TIME_STEP,
    TRAVEL_SPEED,
    TRUE_TIME_STEP,
    VELOCITY,
)
from floatref.stages.speed import TravelSpeed
from floatref.stages.suppression import SuppressLocally
from floatref.stages.timer_distortion import IntegrateReflecting, adjusted_time_step
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance import golden
from floatref_conformance.schemas import enforce

ROOT = Path(__file__).parents[2]
SHARED = {DISTANCE, TRAVEL_SPEED, CUTOFF, TIME, TIME_STEP, TRUE_TIME_STEP}
SECTIONS = {"b3s1": "B3S1", "b3s2": "B3S2", "b3s1r": "B3S1R", "b3s2r": "B3S2R"}


def channel(name):
    return ChannelId(name, None if name in SHARED else "main")


def through(stage, axis, step, wanted, **signals):
    """Return channel ``wanted`` of what the stage makes of ``signals`` in blocks of 50."""
    values = {channel(name): x for name, x in signals.items()}
    rate = Fraction(1 / step).limit_denominator(10**6)
    stage.start(Header(axis, step, 0.0, rate, frozenset(values), ("main",)))
    starts = list(range(0, len(next(iter(values.values()))), 50))
    if stage.direction.name == "BACKWARD":
        starts.reverse()
    blocks = [
        stage.push(Block(first, {c: x[first : first + 50] for c, x in values.items()}))
        for first in starts
    ]
    blocks += stage.finish()
    return np.concatenate([b[channel(wanted)] for b in sorted(blocks, key=lambda b: b.first)])


def section(stage, s, i):
    kind, name, *form = stage.split("-")
    suffix = SECTIONS[name]
    if form:
        prefix = {"varying": "Varying", "state": "State"}[form[0]]
        made = getattr(varying, f"{prefix}HighPass{suffix}")(HEIGHT)
        y = through(made, Axis.TIME, s["step"], HEIGHT, height=i["x"], high_pass_cutoff=i["cutoff"])
    else:
        prefix = {"lpf": "LowPass", "hpf": "HighPass"}[kind]
        made = getattr(butterworth, f"{prefix}{suffix}")(HEIGHT, s["cutoff"])
        y = through(made, Axis.TIME, s["step"], HEIGHT, height=i["x"])
    return {"y": y}


def integral(s, i):
    start = np.full(i["x"].size, s["start"])
    stage = Integrate(VELOCITY, REFERENCE_HEIGHT, starts_at=HEIGHT)
    signals = {VELOCITY: i["x"], HEIGHT: start}
    return {"y": through(stage, Axis.TIME, s["step"], REFERENCE_HEIGHT, **signals)}


def travel_speed(s, i):
    stage = TravelSpeed(s["window_s"])
    return {"speed": through(stage, Axis.TIME, 1 / s["rate_hz"], TRAVEL_SPEED, **i)}


def cut_off(s, i):
    interval_m = s.pop("interval_m")
    schedule = AdaptiveCutOff(transition_speed=s.pop("transition_speed_mps"), **s)
    frequency = schedule.frequency(i["speed"])
    return {"frequency": frequency, "wave_number": schedule.wave_number(i["speed"], interval_m)}


def suppressed(s, i):
    rate_hz = s.pop("rate_hz")
    signals = {VELOCITY: i["x"], TRAVEL_SPEED: i["speed"]}
    stage = SuppressLocally(VELOCITY, **s)
    return {"y": through(stage, Axis.TIME, 1 / rate_hz, VELOCITY, **signals)}


def projected(s, i):
    stage = ToDistance(s["interval_m"], float(i["distance"][0]))
    return {"y": through(stage, Axis.TIME, 0.01, HEIGHT, distance=i["distance"], height=i["x"])}


def distorted(s, i):
    limit_s = s["interval_m"] / s["slow_speed_mps"]
    return {"adjusted": adjusted_time_step(i["time_step"], limit_s, s["sharpness"])}


def over_points(s, i):
    signals = {ACCELERATION: i["x"], TIME_STEP: i["time_step"]}
    stage = Integrate(ACCELERATION, VELOCITY)
    return {"y": through(stage, Axis.DISTANCE, 0.125, VELOCITY, **signals)}


def reflected(s, i):
    signals = {VELOCITY: i["velocity"], HEIGHT: i["height"], TIME_STEP: i["adjusted"]}
    signals[TRUE_TIME_STEP] = i["time_step"]
    r = through(IntegrateReflecting(), Axis.DISTANCE, 0.125, REFERENCE_HEIGHT, **signals)
    return {"reference_height": r}


def observed(s, i):
    signals = {ACCELERATION: i["acceleration"], HEIGHT: i["height"], CUTOFF: i["cutoff"]}
    r = through(MatchedHighPass(), Axis.TIME, 1 / s["rate_hz"], REFERENCE_HEIGHT, **signals)
    return {ELEVATION: r - i["height"]}


def smoothed(s, i):
    names = {"road_m": "road", "long_waves_per_m": "long_waves"}
    step, interval_m = 1 / s.pop("rate_hz"), s.pop("interval_m")
    stage = RoadPriorSmoother(RoadPrior(**{names.get(name, name): x for name, x in s.items()}))
    signals = {ACCELERATION: i["acceleration"], HEIGHT: i["height"], DISTANCE: i["distance"]}
    r = through(stage, Axis.TIME, step, REFERENCE_HEIGHT, **signals)
    made = {"distance": i["distance"], "x": r - i["height"]}
    return {ELEVATION: projected({"interval_m": interval_m}, made)["y"]}


def pipeline(name):
    def run(s, i):
        clock = UniformClock.of(s["rate_hz"])
        channels = (
            Channel.of("vertical_specific_force", i["acceleration"] + 9.80665, clock),
            Channel.of("height", i["height"], clock),
            Channel.of("distance", i["distance"], clock),
        )
        recording = Recording(channels, Setup(s["interval_m"]))
        return {"elevation": floatref.process(recording, name).tracks[0].elevation}

    return run


def roughness(s, i):
    z, interval_m = i["elevation"], s["interval_m"]
    return {"trace": iri_trace(z, interval_m), "iri": [iri(z, interval_m)]}


def agreement(s, i):
    found = cross_correlation(i["p"], i["q"], s["interval_m"], s["max_offset_m"])
    return {name: [value] for name, value in vars(found).items()}


def filtered(s, i):
    return {"filtered": high_pass(i["elevation"], s["interval_m"], s["wavelength_m"])}


def trusted(s, i):
    interval_m = s.pop("interval_m")
    return {"valid": replace_by_validity(i["flags"].astype(np.uint8), interval_m, Reach(**s))}


STAGES = {
    "trapezoidal-rule": integral,
    "travel-speed": travel_speed,
    "adaptive-cut-off": cut_off,
    "local-suppression": suppressed,
    "projection": projected,
    "time-step": lambda s, i: {
        TIME_STEP: through(TimeStep(), Axis.DISTANCE, 0.125, TIME_STEP, time=i["time"])
    },
    "timer-distortion": distorted,
    "spatial-integration": over_points,
    "reflection": reflected,
    "matched-high-pass": observed,
    "road-prior-smoother": smoothed,
    "adaptive-hpf-spatial-backward": pipeline("temporal-adaptive-hpf-spatial-backward"),
    "timer-distortion-reflection": pipeline("spatial-hpf-timer-distortion-reflection"),
    "iri": roughness,
    "cross-correlation": agreement,
    "high-pass": filtered,
    "validity": trusted,
}


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted({*golden.names()} - {"kalman-smoother"}))
def test_the_stages_of_the_sdk_make_of_a_vector_what_the_reference_makes(name):
    vector = golden.read(name)
    inputs = {key: np.array(x, dtype=float) for key, x in vector["inputs"].items()}
    stage, settings = vector["stage"], dict(vector["settings"])
    made = STAGES[stage](settings, inputs) if stage in STAGES else section(stage, settings, inputs)
    assert made.keys() == vector["outputs"].keys()
    for key, expected in vector["outputs"].items():
        allowed = vector["tolerance"]["float64"] * np.abs(expected).max()
        np.testing.assert_allclose(made[key], expected, rtol=0, atol=allowed, err_msg=key)


@pytest.mark.parametrize("name", golden.names())
def test_a_vector_is_small_and_keeps_the_schema(name):
    enforce("floatref-golden-1", golden.read(name))
    assert len((Path(golden.__file__).parent / f"{name}.json").read_bytes()) < 30_000


@pytest.mark.slow
def test_the_vectors_are_what_the_reference_makes_today(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    made = dict(importlib.import_module("golden").documents())
    assert sorted(made) == list(golden.names())
    for name, document in made.items():
        stored = golden.read(name)
        outputs, expected = stored.pop("outputs"), document.pop("outputs")
        assert stored == document
        for key, values in expected.items():
            rounding = 1e-13 * np.abs(values).max()
            np.testing.assert_allclose(outputs[key], values, rtol=0, atol=rounding)


def test_a_copy_holds_every_vector(tmp_path):
    copies = golden.copy_to(tmp_path / "new" / "folder")
    assert [c.stem for c in copies] == list(golden.names())
    for copy in copies:
        assert copy.read_bytes() == (Path(golden.__file__).parent / copy.name).read_bytes()


def test_what_cannot_be_is_refused_in_a_line(tmp_path):
    with pytest.raises(InputError, match="hpf-b3s3: unknown; did you mean hpf-b3s"):
        golden.read("hpf-b3s3")
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(InputError, match="choose another folder"):
        golden.copy_to(tmp_path / "file")
