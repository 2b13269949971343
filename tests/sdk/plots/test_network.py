"""The drawing of a summary: every segment once, every failure said, on a map where it can be."""

import math
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure

from floatref.errors import InputError
from floatref.plots import SUMMARY_COLUMNS, draw_summary
from floatref.plots.network_columns import segments_of

Columns = dict[str, Sequence[Any]]
IRI = "iri_of_valid_m_per_km"
SHORT = {
    "length": "length_m",
    "lat": "latitude_deg",
    "lon": "longitude_deg",
    "iri": "iri_of_valid_m_per_km",
    "index": "mean_roughness_index_of_valid_m_per_km",
    "flagged": "flagged_m",
    "share": "counted_share",
}


def row(name: str, segment: int | None = 0, **values: float | None) -> dict[str, Any]:
    """Return one row; what is not given is not known, without ``segment`` it failed."""
    found = dict.fromkeys(SUMMARY_COLUMNS)
    status = "failed" if segment is None else "done"
    found |= {"name": name, "status": status, "segment": segment}
    return found | {SHORT[key]: value for key, value in values.items()}


def columns(*rows: dict[str, Any]) -> Columns:
    return {name: [each[name] for each in rows] for name in SUMMARY_COLUMNS}


def network(located: bool, paths: int = 1, files: int = 3) -> Columns:
    rng = np.random.default_rng(0)
    rows = []
    for file, segment in np.ndindex(files, 20):
        iri = rng.uniform(1.0, 4.0, 2)
        place = {"lat": 52.0 + segment / 100, "lon": 0.1 * file} if located else {}
        index = float(iri.mean()) if paths == 2 else None
        for at in range(paths):
            one = row(f"{file}.mf4", segment, length=100.0, iri=iri[at], index=index, flagged=20.0)
            one["counted_share"] = 0.8
            rows.append(one | {SHORT[key]: value for key, value in place.items()})
    return columns(*rows)


def text_of(path: Path) -> str:
    return path.read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("located", [True, False])
@pytest.mark.parametrize("paths", [1, 2])
def test_lengths_shares_and_failures_are_told(tmp_path: Path, located: bool, paths: int) -> None:
    given = network(located, paths)
    for name, value in row("bad.mf4", None).items():
        given[name] = [*given[name], value]
    draw_summary(given, tmp_path / "n.svg")
    text = text_of(tmp_path / "n.svg")
    assert "4 files (1 failed), 6.0 km, 60 segments" in text
    assert "not valid: 20.0 %" in text
    assert ("Mean roughness index of valid points (m/km)" in text) == (paths == 2)
    assert ("IRI of valid points (m/km)" in text) == (paths == 1)
    assert ("Longitude (°)" in text) == located
    assert ("bad.mf4" in text) != located


@pytest.mark.slow
def test_one_degree_is_as_long_one_way_as_the_other(tmp_path: Path) -> None:
    # Sixty degrees north a circle is half as wide in longitude as it is long, so twice in degrees.
    turn = np.linspace(0.0, 2.0 * math.pi, 200)
    rows = [
        row("a", k, length=100.0, iri=2.0, lat=60 + 0.1 * math.sin(t), lon=10 + 0.2 * math.cos(t))
        for k, t in enumerate(turn)
    ]
    places = np.concatenate(list(_dots(_drawn(columns(*rows), tmp_path))))
    width, height = np.ptp(places, axis=0)
    assert width == pytest.approx(height, rel=0.01)


def test_a_network_across_the_date_line_stays_together(tmp_path: Path) -> None:
    rows = [
        row("a", k, length=100.0, iri=2.0, lat=k / 1000, lon=(179.99 + k / 1000 + 180) % 360 - 180)
        for k in range(20)
    ]
    found = segments_of(columns(*rows))
    assert np.diff(found.longitude) == pytest.approx(0.001, abs=1e-9)


def _drawn(given: Columns, folder: Path) -> Figure:
    kept: list[Figure] = []
    real = Figure.savefig

    def keep(figure: Figure, *args: Any, **options: Any) -> None:
        real(figure, *args, **options)
        kept.append(figure)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(Figure, "savefig", keep)
        draw_summary(given, folder / "n.png")
    return kept[0]


def _dots(figure: Figure) -> Iterator[np.ndarray]:
    for ax in figure.axes:
        for dots in ax.collections:
            if isinstance(dots, PathCollection) and len(dots.get_offsets()):
                yield ax.transData.transform(np.asarray(dots.get_offsets()))


@given(
    paths=st.lists(st.sampled_from(["left", "right", "main"]), min_size=1, max_size=3),
    parts=st.integers(1, 5),
    seed=st.integers(0, 99),
)
@settings(deadline=None, max_examples=40)
def test_wheel_paths_of_a_segment_are_one_segment_in_any_order(
    paths: list[str], parts: int, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    iri = rng.uniform(1.0, 4.0, (2, parts, len(paths)))
    rows = [
        row(f"{f}", k, length=50.0 + k, iri=iri[f, k, p], flagged=10.0 * p)
        for f, k, p in np.ndindex(iri.shape)
    ]
    found = segments_of(columns(*rows))
    other = segments_of(columns(*(rows[at] for at in _shuffled_within(rows, rng))))
    np.testing.assert_allclose(found.roughness.reshape(2, parts), iri.mean(axis=2))
    np.testing.assert_allclose(found.length_m.sum(), 2 * sum(50.0 + k for k in range(parts)))
    np.testing.assert_allclose(found.flagged_m, 10.0 * (len(paths) - 1) / 2)
    np.testing.assert_allclose(found.roughness, other.roughness)
    assert found.names == other.names == ("0", "1")


def _shuffled_within(rows: list[dict[str, Any]], rng: np.random.Generator) -> list[int]:
    """Return an order of ``rows`` that leaves the files in theirs."""
    half = len(rows) // 2
    return [*rng.permutation(half), *(half + rng.permutation(half))]


def test_the_index_of_two_paths_goes_before_their_mean() -> None:
    found = segments_of(
        columns(
            row("a", 0, iri=1.0, index=2.5),
            row("a", 0, iri=3.0, index=2.5),
            row("b", 0, iri=1.0),
            row("b", 0, iri=None),
            row("c", None),
            row("d", 0),
        )
    )
    np.testing.assert_array_equal(found.roughness, [2.5, 1.0, np.nan])
    np.testing.assert_array_equal(found.paired, [True, False, False])
    np.testing.assert_array_equal(found.failed, [False, False, True, False])
    np.testing.assert_array_equal(found.file, [0, 1, 3])


@pytest.mark.slow
def test_one_wild_segment_does_not_hide_the_others(tmp_path: Path) -> None:
    given = network(False)
    given[IRI] = [1e6, *given[IRI][1:]]
    bars = _drawn(given, tmp_path).axes[0].patches
    assert sum(bar.get_height() for bar in bars) == pytest.approx(6.0)
    draw_summary(given, tmp_path / "n.svg")
    assert "at the end: 1 segment above" in text_of(tmp_path / "n.svg")


@pytest.mark.slow
def test_segments_without_a_position_or_an_iri_are_counted(tmp_path: Path) -> None:
    given = network(True)
    given["latitude_deg"] = [*[None] * 7, *given["latitude_deg"][7:]]
    given[IRI] = [*[None] * 10, *given[IRI][10:]]
    draw_summary(given, tmp_path / "n.svg")
    text = text_of(tmp_path / "n.svg")
    assert "7 of 60 segments without a position" in text
    assert "60 segments (10 without IRI)" in text


@pytest.mark.slow
@pytest.mark.parametrize("place", [{}, {"lat": 1.0, "lon": 2.0}])
def test_nothing_but_failures_or_unknown_is_drawn_all_the_same(
    tmp_path: Path, place: dict[str, float]
) -> None:
    draw_summary(columns(row("a$x^$", None), row("_b", 0, **place)), tmp_path / "n.svg")
    assert "2 files (1 failed), 0.0 km, 1 segment (1 without IRI)" in text_of(tmp_path / "n.svg")
    draw_summary(columns(), tmp_path / "none.png")
    assert (tmp_path / "none.png").exists()


@pytest.mark.slow
def test_names_are_told_while_there_is_room(tmp_path: Path) -> None:
    for files, named in ((24, True), (25, False)):
        draw_summary(network(False, files=files), tmp_path / "n.svg")
        assert bool(re.search("<!-- 7.mf4 -->", text_of(tmp_path / "n.svg"))) == named


def test_columns_that_do_not_fit_are_one_line(tmp_path: Path) -> None:
    given = network(True)
    with pytest.raises(InputError, match="column flagged_m: missing"):
        draw_summary({k: v for k, v in given.items() if k != "flagged_m"}, tmp_path / "n.png")
    with pytest.raises(InputError, match="column segment: has 1 rows and name 60"):
        draw_summary({**given, "segment": [1]}, tmp_path / "n.png")
    with pytest.raises(InputError, match="not the name of a drawing"):
        draw_summary(given, tmp_path / "n.json")
    assert not list(tmp_path.iterdir())
