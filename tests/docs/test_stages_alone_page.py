"""The page on each stage alone: its examples run and give what the reference gives."""

import importlib
import re
from pathlib import Path

import numpy as np
import pytest

from floatref_reference.appendix_a.filters import hpf_b3
from floatref_reference.beyond import matched_high_pass, state_variable
from floatref_reference.chapter_5 import (
    section_5_3,
    section_5_5,
    section_5_6,
    section_5_7,
    section_5_9,
    section_5_10,
)

PAGE = (Path(__file__).parents[2] / "docs" / "stages-alone.md").read_text(encoding="utf-8")
SECTIONS = dict(re.findall(r"^## ([^\n]+)\n(.*?)(?=^## |\Z)", PAGE, re.M | re.S))
RATE, STEP, INTERVAL, CHUNK = 4000, 1 / 4000, 0.025, 160
WAVE_NUMBER = 1 / 105.91


class Vendor:
    """What the examples take for granted: chunks, integrals, and somewhere to keep the result."""

    def __init__(self):
        rng = np.random.default_rng(4)
        self.a = rng.standard_normal(2000)
        self.h = 0.3 + 0.001 * np.cumsum(rng.standard_normal(2000))
        self.distance = np.cumsum(np.clip(np.linspace(9.0, -3.0, 2000), 0.0, None)) / RATE
        self.dt = np.append(0.0, rng.choice([0.002, 0.01, 3.0], 1999))
        self.saved = []

    def chunks(self):
        return self._pieces(self.distance)

    def points(self):
        return self._pieces(self.dt)

    def _pieces(self, third):
        for i in range(0, 2000, CHUNK):
            yield tuple(x[i : i + CHUNK] for x in (self.a, self.h, third))

    def keep(self, *signals):
        self.saved.append(signals)

    def kept(self):
        return tuple(map(np.concatenate, zip(*self.saved, strict=True)))

    def names(self):
        first, second, over = Integral(), Integral(), Integral()
        return {
            "chunks": self.chunks,
            "points": self.points,
            "keep": self.keep,
            "kept": self.kept,
            "first_integral": lambda x: first(x, STEP),
            "second_integral": lambda x: second(x, STEP),
            "first_integral_over": over,
        }


class Integral:
    """Running trapezoidal integral at a step, or one per sample."""

    total = last = None

    def __call__(self, x, step):
        y = np.empty(x.size)
        for i, (value, dt) in enumerate(np.broadcast(x, step)):
            self.total = 0.0 if self.last is None else self.total + 0.5 * dt * (value + self.last)
            self.last, y[i] = value, self.total
        return y


@pytest.fixture
def vendor():
    return Vendor()


def run(section, vendor):
    """Return the names after the example of ``section``."""
    (code,) = re.findall(r"^```python\n(.*?)^```$", SECTIONS[section], re.M | re.S)
    names = vendor.names()
    exec(code, names)
    return names


def close(found, expected):
    np.testing.assert_allclose(found, np.asarray(expected, dtype=float), rtol=0, atol=1e-10)


def test_the_high_pass_and_its_set_of_calls(vendor):
    found = run("The high-pass and its set of calls", vendor)["profile"]
    cutoff = section_5_7.cut_off_frequency(section_5_6.travel_speed(vendor.distance, RATE))
    forward = section_5_7.forward_profile(vendor.a, vendor.h, cutoff, RATE)
    close(found, section_5_7.backward_passes_varying(forward, cutoff, STEP))


def test_the_cut_off_in_a_filter_of_your_own(vendor):
    names = run("The cut-off in a filter of your own", vendor)
    close(names["hertz"], section_5_7.cut_off_frequency(names["speed"]))
    close(names["cycles_per_metre"], section_5_7.cut_off_wave_number(names["speed"], 0.025))


def test_low_speed_in_time(vendor):
    run("Low speed in time", vendor)
    speed = section_5_6.travel_speed(vendor.distance, RATE)
    d = section_5_3.trapezoidal_rule(vendor.a, STEP)
    v = section_5_6.controlled_velocity(d, speed, STEP)
    close(vendor.kept()[0], section_5_3.trapezoidal_rule(v, STEP) - vendor.h)


def test_low_speed_over_distance(vendor):
    found = run("Low speed over distance", vendor)["profile"]
    limit = section_5_10.time_step_limit(INTERVAL)
    steps = section_5_10.adjusted_time_step(vendor.dt, limit)
    v = section_5_9.high_passed_velocity(vendor.a, steps, 105.91, INTERVAL)
    height = hpf_b3(section_5_5.from_first(vendor.h), WAVE_NUMBER, INTERVAL)
    z = section_5_10.reflected_position(v, steps, vendor.dt, height) - height
    close(found, section_5_5.backward_passes(z, WAVE_NUMBER, INTERVAL))


def test_in_place_of_both_integrals(vendor):
    found = run("In place of both integrals", vendor)["profile"]
    cutoff = section_5_7.cut_off_frequency(section_5_6.travel_speed(vendor.distance, RATE))
    z = section_5_3.temporal_profile(vendor.a, vendor.h, RATE)
    e = matched_high_pass.matched_filter(z, cutoff, STEP)
    second = state_variable.hpf_b3s2r_state_variable(e, cutoff, STEP)
    close(found, state_variable.hpf_b3s1r_state_variable(second, cutoff, STEP))


def test_every_example_is_run_and_every_class_is_in_the_table():
    tested = [name for name, text in SECTIONS.items() if "```python" in text]
    assert len(tested) == PAGE.count("```python") == 5
    retrofit = importlib.import_module("floatref.retrofit")
    classes = [name for name, value in vars(retrofit).items() if isinstance(value, type)]
    assert len(classes) == 9
    for name in classes:
        assert f"| [`{name}`][" in PAGE
        assert name in importlib.import_module("floatref").__all__
