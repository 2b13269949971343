"""Adapters of tests, made known to all commands; drives drawn; a browser that draws pages."""

import os
import shutil
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import strategies as st

from floatref import hookimpl
from floatref.engine import formats, plugins, run
from floatref.engine.recordings import readers
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup


@pytest.fixture
def know(monkeypatch: pytest.MonkeyPatch) -> Callable[[object], None]:
    """Make an adapter known, as the package of a vendor does, and no other."""

    def install(adapter: object) -> None:
        class Plugin:
            @hookimpl
            def floatref_register_adapters(self, register: Callable[[object], None]) -> None:
                register(adapter)

        loaded = plugins.Plugins()
        loaded.add(Plugin(), "logger")
        for module in (formats, readers, run):
            monkeypatch.setattr(module, "plugins", lambda: loaded)

    return install


G = 9.80665
HARDEST = 12.0
"""No vehicle of these drives speeds up or brakes harder, in m/s²: an encoder that stops at once has
lost counts."""


def _speed(legs, rate):
    wanted = np.concatenate([np.full(round(seconds * rate), speed) for speed, seconds in legs])
    speed, step = [wanted[0]], HARDEST / rate
    for target in wanted[1:]:
        speed.append(np.clip(target, speed[-1] - step, speed[-1] + step))
    return np.array(speed)


@st.composite
def drives(draw, rate_hz, interval_m, tracks=("left", "right")):
    """A recording of 0.3 to 2 s: stretches of speed, stops among them, noise on all sensors."""
    legs = draw(
        st.lists(
            st.tuples(st.sampled_from([0.0, 0.02, 0.5, 5.0, 20.0, 33.0]), st.floats(0.1, 0.5)),
            min_size=3,
            max_size=4,
        )
    )
    begun = draw(st.sampled_from([0.3, 1.0, 3.0, 8.0]))
    speed = _speed([(begun, 0.1), *legs], rate_hz)
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    count_m = draw(st.sampled_from([0.0003, 0.00127, 0.01]))
    distance = draw(st.sampled_from([0.0, 1234.5])) + count_m * np.floor(
        np.cumsum(speed) / rate_hz / count_m
    )
    bias = draw(st.floats(-0.5, 0.5))
    clock = UniformClock.of(rate_hz, draw(st.sampled_from([0.0, 17.25])))
    channels = [Channel.of("distance", distance, clock)]
    for track in tracks:
        force = G + bias + rng.standard_normal(speed.size)
        height = 0.3 + 0.01 * rng.standard_normal(speed.size).cumsum() / np.sqrt(rate_hz)
        channels.append(Channel.of("vertical_specific_force", force, clock, track))
        channels.append(Channel.of("height", height, clock, track))
    return Recording(tuple(channels), Setup(profile_interval_m=interval_m))


@pytest.fixture
def drawn():
    return drives


@pytest.fixture
def steady():
    """Return a maker of one-track recordings at 20 m/s, any channel or its values replaced."""

    def make(seconds=4.0, rate_hz=1000.0, **replaced):
        count = int(seconds * rate_hz)
        clock = UniformClock.of(rate_hz)
        times = np.arange(count) / rate_hz
        channels = {
            "vertical_specific_force": G + 0.3 * np.sin(9.0 * times),
            "height": 0.3 + 0.005 * np.cos(7.0 * times),
            "distance": 20.0 * times,
            **replaced,
        }
        made = (
            x if isinstance(x, Channel) else Channel.of(name, x, clock)
            for name, x in channels.items()
        )
        return Recording(tuple(made), Setup(profile_interval_m=0.05))

    return make


CHROMIUM = ("chromium", "chromium-browser", "google-chrome", "chrome")


# Its driver holds an event loop open, in which no other test of this process could start its own:
# so each file of tests has one for itself, and ends it.
@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """Return a headless Chromium; without one, CI fails and others skip the test."""
    found = next(filter(None, map(shutil.which, CHROMIUM)), None)
    if found is None:
        reason = f"no browser: install one of {', '.join(CHROMIUM)} (apt-get install chromium)"
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield browser
        browser.close()
