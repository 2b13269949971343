"""The page on innovations: its figures come out again, and it names every kind, key and setting."""

import re
import warnings
from pathlib import Path

import pytest

from floatref.cli.diagnostics import DIGITS, SUFFIX
from floatref.engine.plugins import plugins
from floatref.engine.run import run
from floatref.estimators.kalman.normalized import NAMES
from floatref.estimators.road_prior.misfits import MOVING, STANDING
from floatref_conformance.proving_ground.scenario import scenario_of_run
from floatref_conformance.proving_ground.simulate import simulate

PAGE = (Path(__file__).parents[2] / "docs" / "innovations.md").read_text(encoding="utf-8")
RUN = "sg_5.8s_0.17g"
ROW = re.compile(r"^\| `([\w-]+)` \| `(\w+)` \| (\d+) \| ([\d.e-]+) \| ([\d.]+) \|$", re.M)
PIPELINES = [n for n in plugins().pipelines() if n.startswith(("kalman-", "road-prior-"))]


def printed() -> dict[str, dict[str, tuple[int, float, float]]]:
    """Return count, mean NIS and share within two sigma by pipeline and kind."""
    table = PAGE.partition("<!-- nis -->")[2].partition("<!-- end of nis -->")[0]
    found: dict[str, dict[str, tuple[int, float, float]]] = {}
    for pipeline, kind, count, nis, share in ROW.findall(table):
        found.setdefault(pipeline, {})[kind] = int(count), float(nis), float(share)
    return found


def test_every_pipeline_with_a_filter_is_in_the_table() -> None:
    assert list(printed()) == PIPELINES


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", PIPELINES)
def test_the_figures_come_out_again(pipeline: str) -> None:
    made = simulate(scenario_of_run(RUN, 0, imu=True, gnss=True, response=True))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        record = run(made.recording, pipeline, diagnostics=True).profile.provenance["innovations"]
    expected = printed()[pipeline]
    assert list(record["left"]) == list(expected)
    for kind, (count, nis, share) in expected.items():
        own = record["left"][kind]
        assert own["count"] == pytest.approx(count, abs=2)
        assert own["mean_nis"] == pytest.approx(nis, rel=0.02, abs=1e-4)
        assert own["within_2_sigma_percent"] == pytest.approx(share, abs=0.2)


def test_every_kind_is_explained_with_settings_that_there_are() -> None:
    table = PAGE.partition("## The kinds of readings")[2].partition("## The picture")[0]
    rows = re.findall(r"^\| (`.+?) \| .+ \| (.+) \|$", table, re.M)
    kinds = re.findall(r"`(\w+)`", " ".join(kind for kind, _ in rows))
    assert kinds == [*NAMES, MOVING, STANDING]
    known = {name for n in PIPELINES for name in plugins().pipeline(n).settings}
    named = {s for _, text in rows for s in re.findall(r"`(\w+)`", text)}
    assert named <= known


def test_every_key_and_the_name_of_the_picture_are_there() -> None:
    for key in ("count", *DIGITS, "left_out"):
        assert f"`{key}`" in PAGE
    assert f"`{SUFFIX}`" in PAGE
