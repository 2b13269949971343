"""The page on live streams: its example runs, and its table and figures are those of the code."""

import re
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref.live import bounds
from floatref.live.bounds import Bounds
from floatref.values.channels import STANDARD_GRAVITY

PAGE = (Path(__file__).parents[2] / "docs" / "live.md").read_text(encoding="utf-8")


def latencies():
    """Return the rows of the table, as the code has them."""
    for name in floatref.pipelines():
        pipeline = floatref.pipeline(name)
        found = Bounds.of(pipeline.resolve({})).latency
        first = "–" if pipeline.architecture == "response" else f"{bounds.TICK_S + 5.0:g}"
        numbers = (found.then_s, found.standing_s, found.longest_s)
        cells = [f"{found.travelled_m:.0f}", *(f"{x:.1f}" for x in numbers), first]
        yield f"| `{name}` | {' | '.join(cells)} |"


def test_the_table_has_the_latency_of_every_pipeline():
    table = PAGE.partition("<!-- latency -->\n")[2].partition("<!-- /latency -->")[0]
    assert table.splitlines()[2:] == list(latencies())


def test_the_figures_of_the_text_are_those_of_the_code():
    assert f"*core* of {bounds.CORE_M:,.0f} m" in PAGE
    assert f"three cut-off wavelengths, {bounds.SETTLED * bounds.WAVELENGTH_M:.0f} m" in PAGE
    assert f"joined over {bounds.WAVELENGTH_M / 2:.0f} m" in PAGE
    assert f"core after {bounds.CORE_S:g} s, at most {bounds.OVERDUE * bounds.CORE_S:g} s" in PAGE
    assert f"A standstill of {bounds.STANDS_S:g} s ends a window" in PAGE
    assert f"begins {bounds.BEFORE_S:g} s before the vehicle moves again" in PAGE
    assert f"by up to {bounds.LATE_S:g} s of recorded time" in PAGE
    most = Bounds()
    assert most.longest_s == 120 + 225 + 120 + 0.5 + 5
    lasts_s = (bounds.CORE_M + most.fade_m + 2 * most.settle_m) / 20.0
    usual_mb = 8 * 5 * 16_000 * lasts_s / 1e6
    assert f"lasts {lasts_s:.0f} s, {usual_mb:.0f} MB" in PAGE.replace("\n", " ")
    (first,) = re.findall(r"that is (\d+) MB in slow traffic", PAGE)
    assert int(first) == round(8 * 5 * 16_000 * most.longest_s / 1e6, -1)


@pytest.mark.slow
def test_the_example_runs():
    (code,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.M | re.S)
    times = np.arange(30_000) / 1000.0
    values = {
        "left.vertical_specific_force": STANDARD_GRAVITY + 0.3 * np.sin(9.0 * times),
        "left.height": 0.3 + 0.005 * np.cos(7.0 * times),
        "distance": 20.0 * times,
    }
    shown = []
    names = {
        "source": ({k: v[i : i + 500] for k, v in values.items()} for i in range(0, 30_000, 500)),
        "show": lambda *given: shown.append(given),
    }
    exec(compile(code.replace("16000.0", "1000.0"), "live.md", "exec"), names)
    # How many are there before the end depends on the thread.
    assert {str(state) for state, *_ in shown} <= {"provisional"}
    assert 590.0 < names["profile"].length_m < 600.0
