"""Runs as viewers export them: no unit of heights, and another name in every file."""

from pathlib import Path

import numpy as np
import pytest

FOOT_M, INCH_M, INTERVAL_M = 0.3048, 0.0254, 0.05


def road(seed: int) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 4e-4, 4000))


def text(path: Path, name: str, *tracks: np.ndarray) -> Path:
    """Write ``tracks`` in inches over feet, under names that begin with ``name``."""
    titles = "\t".join(
        f"{name}_ODS{k} - Distance (ft)\t{name}_ODS{k}_Full" for k in range(1, len(tracks) + 1)
    )
    places = INTERVAL_M / FOOT_M * np.arange(tracks[0].size)
    rows = (
        "\t".join(f"{place:.12g}\t{z[k] / INCH_M:.12g}" for z in tracks)
        for k, place in enumerate(places)
    )
    path.write_text("\n".join((titles, *rows)) + "\n", encoding="utf-8")
    return path


def test_compare_says_what_it_guessed_and_which_path_is_which(tmp_path: Path, reported) -> None:
    reference = text(tmp_path / "a.txt", "L1run1", road(1), road(2))
    run = text(tmp_path / "b.txt", "L1run2", road(1)[300:], road(2)[300:])
    found = reported("compare", reference, run)
    first, second, *names = found["notes"]
    assert first.startswith(f"{reference}: no unit of heights is stated: taken as in")
    assert second.startswith(f"{run}: no unit of heights is stated: taken as in")
    assert [line.removeprefix(f"{run}: ") for line in names] == [
        f"its wheel path L1run2_ODS{k} is L1run1_ODS{k} of the reference" for k in (1, 2)
    ]
    assert found["placement_m"] == pytest.approx(-300 * INTERVAL_M, abs=INTERVAL_M)
    assert all(track["cross_correlation"] > 0.99 for track in found["tracks"])


def test_other_roads_under_other_names_are_not_matched(tmp_path: Path, refused) -> None:
    reference = text(tmp_path / "a.txt", "L1run1", road(1))
    assert "give both the same names" in refused(
        "compare", reference, text(tmp_path / "b.txt", "L1run2", road(3))
    )


def test_convert_guesses_only_if_it_is_asked_to(tmp_path: Path, ran, refused, reported) -> None:
    run = text(tmp_path / "a.txt", "run", road(1))
    out = tmp_path / "out"
    assert "states no unit" in refused("convert", run, "--out", out)
    assert not out.exists()
    said = ran("convert", run, "--out", out, "--guess-units").stderr
    assert "taken as in" in said
    assert said.strip().count("\n") == 0
    assert reported("compare", out, run)["tracks"][0]["cross_correlation"] > 0.9999
