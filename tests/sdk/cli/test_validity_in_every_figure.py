"""Nothing is printed, averaged, ranked or drawn over invalid points without a mark.

Profiles are drawn at random with spans that are not valid, in which the elevation is wrong by
metres: every figure of valid points is that of the right road, and all others have a mark.
"""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure

from floatref.batch.jobs.job import Job
from floatref.batch.results.record import Record
from floatref.batch.results.segments import measure_segments
from floatref.batch.results.totals import Tally
from floatref.cli.batch.batch_report import print_report
from floatref.cli.main import main
from floatref.files import write_profile
from floatref.plots import SUMMARY_COLUMNS, draw_comparison, draw_profile, draw_summary
from floatref.values.profile import Profile, ProfileTrack

INTERVAL, COUNT, SEGMENT_M = 0.25, 800, 50.0
SPANS = st.lists(st.tuples(st.integers(0, COUNT), st.integers(0, 300)), max_size=3)
SEEDS = st.integers(0, 2**32 - 1)
ALL_POINTS = ("iri_m_per_km", "mean_roughness_index_m_per_km")
FEW = settings(deadline=None, max_examples=10)


def road(seed: int) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 1e-3, COUNT))


def run(seed: int, *spans: list[tuple[int, int]], wrong: bool = False) -> Profile:
    """Return a profile with a wheel path for each of ``spans``, which are invalid and ``wrong``."""
    tracks = []
    for path, (name, lost) in enumerate(zip(("left", "right"), spans, strict=False)):
        valid = np.ones(COUNT, dtype=bool)
        for first, size in lost:
            valid[first : first + size] = False
        z = road(seed + path)
        if wrong:
            z = np.where(valid, z, 30.0 * np.random.default_rng(seed).normal(size=COUNT))
        tracks.append(ProfileTrack.of(name, z, valid, np.full(COUNT, 1e-3)))
    return Profile(INTERVAL, tuple(tracks), pipeline="temporal-basic")


@contextmanager
def folder(**profiles: Profile) -> Iterator[Path]:
    with TemporaryDirectory() as name:
        for key, profile in profiles.items():
            write_profile(profile, Path(name, key))
        yield Path(name)


def printed(*words: object) -> str:
    done = CliRunner().invoke(main, [str(word) for word in words])
    assert done.exit_code == 0, done.output
    return done.stdout


def valid_figures(value: Any) -> Any:
    """Return only the figures of valid points in a JSON document, and their shares."""
    if isinstance(value, dict):
        return {
            key: valid_figures(each)
            for key, each in value.items()
            if isinstance(each, dict | list) or "valid" in key or "counted" in key
        }
    return [valid_figures(each) for each in value] if isinstance(value, list) else value


def is_marked(line: str) -> bool:
    return line.split()[1] == "*" or " * " in line


@pytest.mark.slow
@FEW
@given(SEEDS, SPANS, SPANS)
def test_iri_gives_the_figures_of_the_right_road_and_marks_the_others(
    seed: int, left: list[tuple[int, int]], right: list[tuple[int, int]]
) -> None:
    with folder(a=run(seed, left, right), b=run(seed, left, right, wrong=True)) as where:
        good, bad = (
            json.loads(printed("iri", where / name, "--segment", SEGMENT_M, "--json"))
            for name in "ab"
        )
        text = printed("iri", where / "b", "--segment", SEGMENT_M)
    assert valid_figures(good) == valid_figures(bad)
    shown = [line for line in text.splitlines() if line.startswith((" left", " right", " mean"))]
    tracks = bad["tracks"]
    figures = [*tracks, {"counted_share": bad["mean_roughness_index_counted_share"]}]
    figures += [segment for track in tracks for segment in track["segments"]]
    assert len(shown) == len(figures)
    for line, figure in zip(shown, figures, strict=True):
        assert is_marked(line) == (figure["counted_share"] < 1.0)
        if not figure["counted_share"]:
            assert " – " in line
    assert ("\n* not all points are valid" in text) == any(map(is_marked, shown))


@pytest.mark.slow
@FEW
@given(SEEDS, SPANS, SPANS)
def test_compare_compares_what_is_valid_in_both(
    seed: int, one: list[tuple[int, int]], other: list[tuple[int, int]]
) -> None:
    pairs = {"r": run(seed, one), "p": run(seed, other)}
    wrong = {"x": run(seed, one, wrong=True), "y": run(seed, other, wrong=True)}
    with folder(**pairs, **wrong) as where:
        good, bad = (
            json.loads(printed("compare", where / a, where / b, "--json")) for a, b in ("rp", "xy")
        )
        text = printed("compare", where / "x", where / "y")
    assert valid_figures(good) == valid_figures(bad)
    (track,) = bad["tracks"]
    found, expected = track["iri_of_valid_m_per_km"], track["iri_reference_of_valid_m_per_km"]
    assert found == expected
    sound = run(seed, one)["left"].valid & run(seed, other)["left"].valid
    agreement, valid, bands = [line for line in text.splitlines() if line.startswith(" left")]
    assert is_marked(agreement) == is_marked(bands) == (not sound.all())
    assert not is_marked(valid)
    assert (found is None) == (" – " in valid) == (track["counted_share"] == 0.0)


def records(seed: int, spans: list[list[tuple[int, int]]], wrong: bool) -> list[Record]:
    made = []
    for file, lost in enumerate(spans):
        profile = run(seed + 2 * file, lost, lost[:1], wrong=wrong)
        rows, _ = measure_segments(profile, SEGMENT_M)
        made.append(Record(f"run-{file}", "/run", rows=rows, length_m=profile.length_m))
    return made


def tally_of(made: list[Record]) -> Tally:
    tally = Tally()
    for record in made:
        tally.add(Job(Path("/in"), record.name, Path("/out")), record)
    return tally


@FEW
@given(SEEDS, st.lists(SPANS, min_size=1, max_size=3))
def test_batch_ranks_the_right_road_and_marks_what_is_left_of_it(
    seed: int, spans: list[list[tuple[int, int]]]
) -> None:
    good, bad = (tally_of(records(seed, spans, wrong)) for wrong in (False, True))
    kept = [
        [replace(row, **dict.fromkeys(ALL_POINTS, 0.0)) for _, _, row in tally.roughest]
        for tally in (good, bad)
    ]
    # As texts: a NaN is not equal to itself in a dataclass, from Python 3.13 on.
    assert repr(kept[0]) == repr(kept[1])
    assert good.not_ranked == bad.not_ranked
    assert all(row.counted_share * row.length_m >= SEGMENT_M / 2 - 1.0 for row in kept[1])
    for record in records(seed, spans, wrong=True):
        for row in record.rows:
            assert 0.0 <= row.flagged_m <= row.length_m
            assert (row.counted_share < 1.0) >= (row.flagged_m > 0.0)


def test_the_roughest_has_a_mark_if_not_all_of_it_is_valid(capsys) -> None:
    tally = tally_of(records(5, [[(210, 60)], []], wrong=True))
    files = dict.fromkeys(("found", "done", "skipped", "failed"), 0)
    report = {"files": files, "warnings": 0, "length_km": 0.4, "effort": {}, "failures": []}
    report["effort"] = {"cpu_s": 0.0, "peak_bytes": 0}
    report["pipelines"] = {}
    report["this_run"] = {"wall_s": 1.0, "workers": 1, "processed": 0, "length_km": 0.0}
    print_report(report, tally, Path("out"))
    lines = capsys.readouterr().out.splitlines()
    shown = [line for line in lines if line.startswith(" run-")]
    assert len(shown) == len(tally.roughest)
    for line, (_, _, row) in zip(shown, tally.roughest, strict=True):
        assert (" * " in line) == (row.counted_share < 1.0)


def drawn(draw: Any, monkeypatch: pytest.MonkeyPatch) -> Figure:
    """Return the figure that ``draw`` saves."""
    kept: list[Figure] = []

    def keep(figure: Figure, path: Path, **_: Any) -> None:
        kept.append(figure)
        Path(path).write_bytes(b"")

    monkeypatch.setattr(Figure, "savefig", keep)
    draw()
    return kept[0]


@pytest.mark.parametrize("lost", [[], [(300, 200)], [(0, 30), (700, 100)], [(0, COUNT)]])
def test_lines_are_solid_and_ground_is_white_only_where_points_are_valid(
    lost: list[tuple[int, int]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    profile, reference = run(1, lost, wrong=True), run(1, [])
    valid, target = profile["left"].valid, tmp_path / "p.png"
    for draw in (
        lambda: draw_profile(profile, target),
        lambda: draw_comparison(reference, profile, target),
        lambda: draw_comparison(profile, reference, target),
    ):
        for ax in drawn(draw, monkeypatch).axes:
            solid = [line for line in ax.get_lines() if line.get_linestyle() == "-"]
            heights = [np.isfinite(line.get_ydata()) for line in solid]
            assert heights
            assert not any((each & ~valid[: each.size]).any() for each in heights)
            assert bool(ax.collections) == (not valid.all())
        share = profile.iri()["left"].counted_share
        label = f"over {100.0 * share:.1f} %" if share else "no IRI of valid points"
        texts = [t.get_text() for ax in _legends(draw, monkeypatch) for t in ax.texts]
        assert any(label in text for text in texts)


def _legends(draw: Any, monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    found = [ax.get_legend() for ax in drawn(draw, monkeypatch).axes]
    return [each for each in found if each is not None]


@pytest.mark.slow
@FEW
@given(SEEDS, st.lists(SPANS, min_size=1, max_size=2), st.booleans())
def test_network_is_drawn_from_the_right_road(
    seed: int, spans: list[list[tuple[int, int]]], located: bool
) -> None:
    pictures = []
    for wrong in (False, True):
        rows = [
            {"name": record.name, "status": "done", **asdict(row)}
            | ({"latitude_deg": 50.0 + row.segment, "longitude_deg": 8.0} if located else {})
            for record in records(seed, spans, wrong)
            for row in record.rows
        ]
        columns = {name: [row[name] for row in rows] for name in SUMMARY_COLUMNS}
        with TemporaryDirectory() as name, pytest.MonkeyPatch.context() as patched:
            figure = drawn(lambda c=columns, n=name: draw_summary(c, Path(n, "n.png")), patched)
        legends = [
            t.get_text() for ax in figure.axes for t in getattr(ax.get_legend(), "texts", [])
        ]
        heights = [bar.get_height() for bar in figure.axes[0].patches]
        pictures.append((legends, heights))
        partly = any(row["counted_share"] < 1.0 and row["counted_share"] for row in rows)
        assert any("not all points valid" in text for text in legends) >= partly
    assert pictures[0] == pictures[1]
