"""The golden vectors: inputs of a few hundred samples, and what the reference makes of them."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import golden_kalman as kalman
import golden_road_prior as road_prior
import numpy as np
from numpy.typing import NDArray

from floatref_reference.appendix_a import cut_off, filters, varying
from floatref_reference.beyond import matched_high_pass, state_variable
from floatref_reference.chapter_2.section_2_1_1_iri import iri, iri_trace
from floatref_reference.chapter_2.section_2_1_5_comparison import agreement
from floatref_reference.chapter_5 import section_5_3 as s53
from floatref_reference.chapter_5 import section_5_6 as s56
from floatref_reference.chapter_5 import section_5_7 as s57
from floatref_reference.chapter_5 import section_5_8 as s58
from floatref_reference.chapter_5 import section_5_10 as s510

Array = NDArray[np.float64]
Numbers = Mapping[str, float]
DRIFT, SLOW, BRAKING = 2, 4, 8
REACH = {
    "drift_m": 105.91,
    "run_in_m": 52.955,
    "before_slow_m": 15.0,
    "after_slow_m": 30.0,
    "after_braking_m": 15.0,
}
SCHEDULE = {
    "low_speed_hz": 0.45,
    "wavelength_m": 105.91,
    "transition_speed_mps": 2.778,
    "steepness": 2.5,
}


@dataclass(frozen=True)
class Vector:
    """One replay of ``stage``: settings and inputs as they are fed, outputs as they must come."""

    name: str
    stage: str
    equation: str
    settings: Numbers
    inputs: Mapping[str, Array]
    outputs: Mapping[str, Any] = field(repr=False)


def wave(count: int, *terms: tuple[float, float], mean: float = 0.0) -> Array:
    """Return sines of (amplitude, period in samples), shifted in phase, with six decimals."""
    k = np.arange(count)
    return np.round(mean + sum(a * np.sin(2 * np.pi * k / p + a * p) for a, p in terms), 6)


def stop(count: int, rate_hz: float, speed: float, rest: float) -> Array:
    """Return speeds in m/s of a drive that brakes to a stop, rests and is off again."""
    t = np.arange(count) / rate_hz
    middle = t[-1] / 2
    return np.round(np.clip(speed * (np.abs(t - middle) - rest) / (middle - rest), 0, speed), 6)


def distances(speed: Array, rate_hz: float) -> Array:
    """Return the distance travelled, with six decimals."""
    return np.round(np.concatenate(([0.0], np.cumsum(speed[1:]) / rate_hz)), 6)


def sections() -> Iterator[Vector]:
    """Yield every stage of Table A.1 at a constant cut-off."""
    starts = {"lpf-b3s1": "A.12", "lpf-b3s2": "A.13", "lpf-b3s1r": "A.16", "lpf-b3s2r": "A.17"}
    starts |= {"hpf-b3s1": "A.14", "hpf-b3s2": "A.15", "hpf-b3s1r": "A.18", "hpf-b3s2r": "A.19"}
    for stage, start in starts.items():
        low = stage.startswith("lpf")
        step, cutoff = (1 / 16000, 1000.0) if low else (0.5, 1 / 105.91)
        x = wave(240, (1.0, 97.0), (0.3, 7.3), (0.2, 2.1), mean=9.8 * low)
        yield _section(stage, stage, start, x, step, cutoff)
    for stage in ("hpf-b3s1", "hpf-b3s2"):
        x = wave(240, (0.5, 211.0), (0.1, 5.7), mean=1.0)
        yield _section(f"{stage}-slow", stage, starts[stage], x, 1 / 16000, 0.45)


def _section(name: str, stage: str, start: str, x: Array, step: float, cutoff: float) -> Vector:
    backward = "A.10" if stage.endswith("r") else "A.9"
    y = getattr(filters, stage.replace("-", "_"))(x, cutoff, step)
    settings = {"step": step, "cutoff": cutoff}
    return Vector(name, stage, f"({backward}), Table A.1, ({start})", settings, {"x": x}, {"y": y})


def varying_sections() -> Iterator[Vector]:
    """Yield the high-pass stages at a cut-off that follows a stop."""
    rate_hz, dx = 20.0, 0.5
    in_time = s57.cut_off_frequency(stop(240, rate_hz, 15.0, 2.0)).astype(float)
    over_distance = s57.cut_off_wave_number(stop(240, rate_hz, 15.0, 0.3), dx).astype(float)
    x = wave(240, (1.0, 83.0), (0.3, 9.1), (0.1, 2.3))
    for stage in ("hpf-b3s1", "hpf-b3s2", "hpf-b3s1r", "hpf-b3s2r"):
        step, cutoff = (dx, over_distance) if stage.endswith("r") else (1 / rate_hz, in_time)
        apply = getattr(varying, f"{stage.replace('-', '_')}_varying")
        yield _varying(
            f"{stage}-varying", "(A.9) with c of each sample, (5.3)", apply, x, cutoff, step
        )
    for stage in ("hpf-b3s1r", "hpf-b3s2r"):
        apply = getattr(state_variable, f"{stage.replace('-', '_')}_state_variable")
        yield _varying(f"{stage}-state", "bp' = w hp, lp' = w bp", apply, x, over_distance, dx)


def _varying(
    name: str, equation: str, apply: Callable[..., Any], x: Array, cutoff: Array, step: float
) -> Vector:
    inputs = {"x": x, "cutoff": cutoff}
    return Vector(name, name, equation, {"step": step}, inputs, {"y": apply(x, cutoff, step)})


def in_time() -> Iterator[Vector]:
    """Yield the stages of the temporal architecture."""
    x, rate_hz = wave(240, (1.0, 61.0), (0.4, 6.7), mean=0.2), 1000.0
    settings = {"step": 1 / 16000, "start": 0.3}
    y = s53.trapezoidal_rule(x, 1 / 16000, 0.3)
    yield Vector("trapezoidal-rule", "trapezoidal-rule", "5.3", settings, {"x": x}, {"y": y})
    distance = distances(stop(240, 400.0, 15.0, 0.05), 400.0)
    speed = s56.travel_speed(distance, 400.0)
    yield _one(
        "travel-speed",
        "5.6",
        {"rate_hz": 400.0, "window_s": 0.05},
        {"distance": distance},
        {"speed": speed},
    )
    slow = stop(240, rate_hz, 6.0, 0.01)
    outputs = {
        "frequency": s57.cut_off_frequency(slow),
        "wave_number": s57.cut_off_wave_number(slow, 0.025),
    }
    settings = {**SCHEDULE, "interval_m": 0.025}
    yield _one("adaptive-cut-off", "(5.3)", settings, {"speed": slow}, outputs)
    controlled = s56.controlled_velocity(x, slow, 1 / rate_hz)
    gains = {
        "rate_hz": rate_hz,
        "below_mps": s56.V_ON,
        "proportional": 0.001,
        "integral_per_s": 0.834,
    }
    inputs = {"x": x, "speed": slow}
    yield _one("local-suppression", "(5.1), (5.2)", gains, inputs, {"y": controlled})


def _one(stage: str, equation: str, settings: Numbers, inputs: Any, outputs: Any) -> Vector:
    return Vector(stage, stage, equation, settings, inputs, outputs)


def over_distance() -> Iterator[Vector]:
    """Yield the projection and the stages of the spatial architecture."""
    speed = stop(240, 100.0, 12.0, 0.3)
    distance, x = distances(speed, 100.0), wave(240, (0.02, 71.0), (0.004, 6.1))
    y = s53.capture(x, s53.trigger(distance, 0.05))
    yield _one("projection", "5.3", {"interval_m": 0.05}, {"distance": distance, "x": x}, {"y": y})
    points = s53.trigger(distance, 0.125)
    time = np.array([float(i - 1 + part) / 100.0 for i, part in points])
    dt = s58.time_step(time).astype(float)
    yield _one("time-step", "(5.4)", {}, {"time": time}, {"time_step": dt})
    adjusted = s510.adjusted_time_step(dt, s510.time_step_limit(0.125)).astype(float)
    settings = {"interval_m": 0.125, "slow_speed_mps": 3.576, "sharpness": 25.0}
    yield _one(
        "timer-distortion", "(5.7), (5.8)", settings, {"time_step": dt}, {"adjusted": adjusted}
    )
    v, h = wave(dt.size, (0.1, 43.0), (0.02, 5.0)), wave(dt.size, (0.02, 29.0), (0.002, 3.7))
    integral = s58.velocity(v, adjusted)
    yield _one(
        "spatial-integration", "(5.5), (5.6)", {}, {"x": v, "time_step": adjusted}, {"y": integral}
    )
    inputs = {"velocity": v, "adjusted": adjusted, "time_step": dt, "height": h}
    reflected = s510.reflected_position(v, adjusted, dt, h)
    yield _one("reflection", "(5.9)", {}, inputs, {"reference_height": reflected})


def whole() -> Iterator[Vector]:
    """Yield the two recommended pipelines and the matched high-pass at a stop."""
    rate_hz, dx = 100.0, 0.25
    speed = stop(360, rate_hz, 12.0, 0.3)
    distance = distances(speed, rate_hz)
    a = wave(360, (0.8, 61.0), (0.5, 11.0), mean=0.05)
    h = wave(360, (0.01, 67.0), (0.004, 7.0), mean=0.3)
    inputs = {"acceleration": a, "height": h, "distance": distance}
    settings = {"rate_hz": rate_hz, "interval_m": dx}
    made = {
        "adaptive-hpf-spatial-backward": ("5.7", s57.adaptive_high_pass_spatial_backward),
        "timer-distortion-reflection": ("5.10", s510.timer_distortion_reflection),
    }
    for stage, (section, pipeline) in made.items():
        _, elevation = pipeline(a, h, distance, rate_hz, dx)
        yield _one(stage, section, settings, inputs, {"elevation": elevation})
    cutoff = s57.cut_off_frequency(speed).astype(float)
    e = matched_high_pass.matched_filter(s53.temporal_profile(a, h, rate_hz), cutoff, 1 / rate_hz)
    inputs = {"acceleration": a, "height": h, "cutoff": cutoff}
    yield _one(
        "matched-high-pass", "r' = v + 2w(h - r)", {"rate_hz": rate_hz}, inputs, {"elevation": e}
    )


def smoothers() -> Iterator[Vector]:
    """Yield both smoothers through a stop, smoothed by the whole run."""
    yield _one(*kalman.vector(distances(stop(300, 100.0, 8.0, 0.3), 100.0)))
    given = road_prior.sensors(distances(stop(360, 100.0, 8.0, 0.3), 100.0), 100.0)
    outputs = {"elevation": road_prior.elevation(road_prior.SETTINGS, given, np.longdouble)}
    yield _one("road-prior-smoother", "(2.2), (2.4), (6.17)", road_prior.SETTINGS, given, outputs)


def measures() -> Iterator[Vector]:
    """Yield what is done to a finished profile."""
    z = wave(300, (0.02, 187.0), (0.004, 31.0), (0.001, 7.0))
    settings = {"interval_m": 0.0625}
    outputs = {"trace": iri_trace(z, 0.0625), "iri": [iri(z, 0.0625)]}
    yield _one("iri", "2.1.1", settings, {"elevation": z}, outputs)
    p = wave(240, (1.0, 53.0), (0.4, 11.0))
    q = np.round(0.9 * np.roll(p, 3), 6) + wave(240, (0.2, 17.0))
    found = agreement(p, q, 0.125)
    names = ("cross_correlation", "correlation", "amplitude_factor", "offset_m")
    outputs = {name: [value] for name, value in zip(names, found, strict=True)}
    settings = {"interval_m": 0.125, "max_offset_m": 1.0}
    yield _one("cross-correlation", "(2.12) to (2.16)", settings, {"p": p, "q": q}, outputs)
    cutoff = 1 / cut_off.high_pass_cut_off_wavelength(91.44)
    outputs = {"filtered": filters.hpf_b3x2(z - z[0], cutoff, 0.5)}
    settings = {"interval_m": 0.5, "wavelength_m": 91.44}
    yield _one("high-pass", "HPF_B3x2, (A.22)", settings, {"elevation": z}, outputs)


def validity() -> Iterator[Vector]:
    """Yield which points are valid, each asked for whatever flag is near enough."""
    flags = np.zeros(400)
    flags[[101, 300, 301]] += DRIFT + 1, BRAKING, BRAKING
    flags[[200, 215]] = SLOW, 1
    interval_m, points = 2.0, np.arange(400)
    reaches = {
        DRIFT: (REACH["drift_m"], REACH["drift_m"]),
        SLOW: (REACH["before_slow_m"], REACH["after_slow_m"]),
        BRAKING: (0.0, REACH["after_braking_m"]),
    }
    run_in = round(REACH["run_in_m"] / interval_m)
    valid = (flags == 0) & (points >= run_in) & (points < 400 - run_in)
    for flag, (before, after) in reaches.items():
        for k in points[(flags.astype(int) & flag) != 0]:
            away = points - k
            near = (away >= -round(before / interval_m)) & (away <= round(after / interval_m))
            valid &= ~near
    settings = {"interval_m": interval_m, **REACH}
    yield _one(
        "validity",
        "half and whole cut-off wavelengths",
        settings,
        {"flags": flags},
        {"valid": 1.0 * valid},
    )


def vectors() -> Iterator[Vector]:
    """Yield all vectors."""
    groups = sections, varying_sections, in_time, over_distance, whole, smoothers, measures
    for group in (*groups, validity):
        yield from group()
