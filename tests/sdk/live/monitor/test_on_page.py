"""The page in a browser: what it shows, on a screen and a phone, and that it notices the end."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

from floatref.live.bounds import Latency
from floatref.live.monitor import page_server as page_server_module
from floatref.live.monitor.page_server import page_server
from floatref.live.monitor.run_monitor import RunMonitor
from floatref.live.points import State
from floatref.live.session.messages import Piece
from floatref.live.session.watch import Taken
from floatref.values.clock import UniformClock

pytestmark = pytest.mark.slow
HOSTILE = "<img src=x onerror=alert(1)>"
WAIT_MS = 60_000


STREAM = SimpleNamespace(
    pipelines=("test",),
    latency=Latency(2382.4, 5.5, 35.5, 350.5, 5.5),
    late={"distance": 4},
)


@pytest.fixture
def opened(chromium, monkeypatch):
    """Return what opens the page of a monitor; its console has to be empty at the end."""
    monkeypatch.setattr(page_server_module, "PARTING_S", 0.0)
    contexts, said, asked = [], [], []

    def call(address, **options):
        context = chromium.new_context(**options)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        page.goto(address)
        page.wait_for_selector("#made:not(:empty)", timeout=WAIT_MS)
        return page

    call.said, call.asked = said, asked
    yield call
    for context in contexts:
        context.close()


def filled(made, name="run"):
    monitor = RunMonitor(name, lambda: 5.0)
    names = {"left.height": Piece(np.arange(900.0)), "distance": Piece(np.arange(900.0))}
    monitor.declared(dict.fromkeys([*names, HOSTILE], UniformClock.of(100.0)))
    monitor.started(STREAM)
    monitor.read(names)
    monitor.took(Taken({}, 9.0, 700.0, 20.0))
    profile = made.profile(1, 900.0, 0.25, ("left", "right"))
    for points in made.points(profile, 1, State.PROVISIONAL):
        monitor.gave(points)
    for points in made.points(made.profile(1, 500.0, 0.25, ("left", "right")), 1):
        monitor.gave(points)
    monitor.missed("left.height", 12)
    monitor.event(HOSTILE)
    return monitor


def rows(page, body):
    found = page.locator(f"#{body} tr")
    return [found.nth(k).locator("td").all_inner_texts() for k in range(found.count())]


def test_it_shows_what_the_monitor_shows(opened, made):
    monitor = filled(made)
    with page_server(monitor.shown, 0) as address:
        page = opened(address)
        shown = monitor.shown()
        assert page.title() == "run – floatref live"
        texts = {k: page.inner_text(f"#{k}") for k in ("speed", "distance", "dropped", "late")}
        assert texts == {"speed": "72.0", "distance": "700.0", "dropped": "12", "late": "4"}
        assert page.inner_text("#final") == "499.8"
        assert page.inner_text("#next") == f"{shown.to_final.travel_m:.0f} m"
        sections = rows(page, "sections")
        every = [*shown.sections, shown.running][::-1]
        assert [row[0] for row in sections] == [f"{s.start_m:.1f}" for s in every]
        first = every[-1]
        for text, track in zip(sections[-1][2:], first.tracks, strict=True):
            iri, _, sigma = text.partition(",")[0].split()
            assert float(iri) == pytest.approx(track.iri_m_per_km, abs=0.00051)
            assert float(sigma) == pytest.approx(track.sigma_m_per_km, abs=0.00051)
        assert [row[1] for row in sections if "final" in row[1]] == ["final"] * 3
        assert sections[0][1].startswith("provisional, ")
        # What other programs send is text.
        assert page.locator("#sensors th").all_inner_texts()[2] == HOSTILE
        assert page.inner_text("#events li") == HOSTILE
        assert page.locator("img").count() == 0
        assert {url.removeprefix(address) for url in opened.asked} <= {"", "state.json"}
        page.close()
    assert opened.said == []


def test_it_goes_on_and_says_when_the_connection_is_lost_and_found_again(opened, made):
    monitor = filled(made)
    failing = []

    def shown():
        if failing:
            raise ConnectionError
        return monitor.shown()

    with page_server(shown, 0) as address:
        page = opened(address)
        assert page.is_hidden("#lost")
        monitor.event("another one")
        page.wait_for_selector("#events li:first-child:text-is('another one')", timeout=WAIT_MS)
        failing.append(True)
        page.wait_for_selector("#lost:not([hidden])", timeout=WAIT_MS)
        assert page.inner_text("#lost").startswith("Connection lost; trying again. Last state: ")
        failing.clear()
        page.wait_for_selector("#lost[hidden]", state="attached", timeout=WAIT_MS)
        assert page.locator("#events li").count() == 2
        page_server_module.PARTING_S = WAIT_MS / 1000.0
        monitor.completed()
    page.wait_for_selector("#lost:has-text('The command has ended')", timeout=WAIT_MS)
    assert page.inner_text("#status").startswith("complete")
    # Chromium itself reports the answers that never came.
    assert all("ERR_" in line for line in opened.said)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_phone_scrolls_down_alone_and_a_keyboard_reaches_every_table(
    opened, made, scheme, tmp_path
):
    monitor = filled(made, "run-" + "x" * 80)
    phone = {"viewport": {"width": 390, "height": 780}, "is_mobile": True, "has_touch": True}
    with page_server(monitor.shown, 0) as address:
        page = opened(address, color_scheme=scheme, **phone)
        assert page.evaluate("document.documentElement.scrollWidth") == 390
        reached = []
        for _ in range(3):
            page.keyboard.press("Tab")
            reached.append(page.evaluate("document.activeElement.getAttribute('aria-labelledby')"))
        assert reached == ["sensors-title", "sections-title", "events-title"]
        outline = page.evaluate("getComputedStyle(document.activeElement).outlineStyle")
        assert outline == "solid"
        assert json.loads(page.evaluate(LEAST_CONTRAST)) >= 4.5
        page.close()
    assert opened.said == []


LEAST_CONTRAST = """(() => {
  const parts = (colour) => colour.match(/[0-9.]+/g).slice(0, 3).map((v) => {
    const c = v / 255;
    return c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  });
  const light = (colour) => {
    const [r, g, b] = parts(colour);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const back = light(getComputedStyle(document.body).backgroundColor);
  const found = [...document.querySelectorAll("p, dt, dd, b, td, th, li, h1, h2")].map((each) => {
    const own = light(getComputedStyle(each).color);
    return (Math.max(own, back) + 0.05) / (Math.min(own, back) + 0.05);
  });
  return String(Math.min(...found));
})()"""
