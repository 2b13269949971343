"""How the tests read a page without a browser, and what opens one in it."""

import json
import re
from base64 import b64decode
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from floatref.values.clock import StampedClock, UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording
from floatref.viewer import write_profile_page, write_recording_page
from floatref.viewer.page_file import PageOptions

ARRAY = re.compile(r'<script type="text/plain" id="array-(\d+)">([^<]*)</script>')
DRAWN = "performance.getEntriesByName('drawn').length > 0"
DOCUMENT = re.compile(r'<script type="application/json" id="document">(.*?)</script>', re.DOTALL)


@dataclass(frozen=True)
class Page:
    """The document of a page and its arrays."""

    document: dict[str, Any]
    arrays: list[np.ndarray]
    text: str

    def lines(self, title: str) -> list[dict[str, Any]]:
        """Return the lines of the panel called ``title``."""
        (panel,) = [panel for panel in self.document["panels"] if panel["title"] == title]
        return list(panel["lines"])

    def ends(self, line: dict[str, Any], level: dict[str, Any], part: str = "values") -> Any:
        """Return lowest and highest values of a level of a line, in SI units."""
        low, high = (self.arrays[number].astype(np.float64) for number in level[part])
        return low + line["base"], high + line["base"]

    def marked(self, level: dict[str, Any]) -> np.ndarray:
        """Return which bins of a level are marked."""
        if "marked" not in level:
            return np.zeros(level["bins"], np.bool_)
        return self.arrays[level["marked"]].astype(np.bool_)


@pytest.fixture(scope="session")
def read_page() -> Callable[[Path], Page]:
    """Return what reads a page as its browser does."""

    def read(path: Path) -> Page:
        text = path.read_text(encoding="utf-8")
        found = DOCUMENT.search(text)
        assert found is not None
        document = json.loads(found[1])
        forms = document["arrays"]
        arrays = [
            np.frombuffer(b64decode(match[2]), np.dtype(f"<{forms[int(match[1])]}"))
            for match in ARRAY.finditer(text)
        ]
        assert len(arrays) == len(forms)
        return Page(document, arrays, text)

    return read


@pytest.fixture(scope="session")
def road() -> Callable[..., Profile]:
    """Return what makes a profile of two wheel paths, 0.05 m apart, with 1-σ and invalid spans."""

    def make(count: int = 8000, shift: int = 0, seed: int = 0) -> Profile:
        rng = np.random.default_rng(seed)
        tracks = []
        for name in ("left", "right"):
            z = np.cumsum(rng.normal(0.0, 3e-4, count + 1000))[500 + shift :][:count]
            valid = np.ones(count, np.bool_)
            valid[count // 2 : count // 2 + count // 10] = False
            sigma = np.full(count, 1e-3)
            tracks.append(ProfileTrack.of(name, z + 3.0 * ~valid, valid, sigma))
        return Profile(0.05, tuple(tracks), pipeline="test")

    return make


@pytest.fixture(scope="session")
def drive() -> Recording:
    """Return a recording of 40 s with a stop from 18 to 22 s, a gap in a laser, and GNSS."""
    clock, slow = UniformClock.of(1000.0, 100.0), StampedClock.of(100.0 + np.arange(400) / 10.0)
    time_s = np.arange(40_000) / 1000.0
    speed = 10.0 * np.interp(time_s, [0.0, 14.0, 18.0, 22.0, 26.0, 40.0], [1, 1, 0, 0, 1, 1])
    rng = np.random.default_rng(3)
    height = 0.3 + 1e-3 * rng.standard_normal(time_s.size)
    height[30_000:31_000] = np.nan
    travelled = np.cumsum(speed) / 1000.0
    angle = travelled[::100][:400] / 6.4e6
    channels = [
        Channel.of("distance", travelled, clock),
        Channel.of("height", height, clock, "left"),
        Channel.of("height", 0.3 + 1e-3 * rng.standard_normal(time_s.size), clock, "right"),
        Channel.of("gnss_latitude", 0.8 + angle, slow),
        Channel.of("gnss_longitude", 0.2 + angle, slow),
    ]
    return Recording(tuple(channels))


@pytest.fixture
def opened(chromium: Any) -> Iterator[Callable[..., Any]]:
    """Return what opens a page; at the end its console has to be empty."""
    contexts, said = [], []

    def call(path: Path, **options: Any) -> Any:
        context = chromium.new_context(**({"viewport": {"width": 1200, "height": 900}} | options))
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on("request", lambda request: said.append(request.url) if "http" in request.url else 0)
        page.goto(path.as_uri())
        page.wait_for_function(DRAWN)
        return page

    yield call
    for context in contexts:
        context.close()
    assert said == []


@pytest.fixture(scope="module")
def pages(
    tmp_path_factory: pytest.TempPathFactory, road: Callable[..., Profile], drive: Recording
) -> Path:
    """Return the folder of a page of two runs with a recording, and of that recording."""
    folder = tmp_path_factory.mktemp("pages")
    runs = {"first": road(), "late": road(shift=-8)}
    write_profile_page(folder / "runs.html", runs, PageOptions(), drive)
    write_recording_page(folder / "drive.html", "drive", drive, PageOptions(most_mb=1.0))
    return folder
