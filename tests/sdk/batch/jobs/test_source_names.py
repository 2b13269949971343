"""Names: safe, one for each source, and the same whatever the order."""

import unicodedata
from itertools import permutations
from pathlib import Path, PurePosixPath

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.batch.jobs.job import Job
from floatref.batch.jobs.source_names import name_below, unique_names

FEW = settings(deadline=None, max_examples=100)
LETTERS = st.characters(exclude_characters="/\0")
ODD = st.sampled_from(["..", ".", "...", ".hidden", "CON.", "a ", "\n", "\udc80", "x" * 255, "ß"])
PARTS = st.one_of(ODD, st.text(LETTERS, min_size=1, max_size=8))
PATHS = st.lists(PARTS, min_size=1, max_size=4).map("/".join)
NAMES = st.lists(st.sampled_from(["A1", "a1"]), max_size=2).flatmap(
    lambda folders: st.sampled_from(
        ["run", "run.mf4", "RUN.mf4", "a1", "A1.json", "\u00e9", "e\u0301"]
    ).map(lambda name: "/".join([*folders, name]))
)


def folded(path: Path) -> tuple[str, ...]:
    """Return the parts of ``path`` as the least careful disk tells them apart."""
    return tuple(unicodedata.normalize("NFC", part).casefold() for part in path.parts)


@pytest.mark.slow
@given(path=PATHS)
@FEW
def test_a_name_is_a_path_that_stays_inside_and_can_be_written(path: str) -> None:
    name = name_below(Path("/data") / path, Path("/data"))
    place = PurePosixPath(name)
    assert not place.is_absolute()
    assert str(place) == name
    assert name.isprintable()
    for part in place.parts:
        assert not part.startswith(".")
        assert not part.endswith((".", " "))
        assert not set(part) & set('<>:"|?*\\')
        assert len(part.encode()) <= 200


def test_a_plain_name_is_the_path_below_the_folder() -> None:
    base = Path("/data/2026")
    assert name_below(base / "A1/run 7.mf4", base) == "A1/run 7.mf4"
    assert name_below(base / "stop_0.20g", base) == "stop_0.20g"
    assert name_below(base, base) == "2026"
    assert name_below(Path("/other/run.mf4"), base) == "run.mf4"
    assert name_below(base / "../other/run.mf4", base) == "run.mf4"


@pytest.mark.slow
@given(names=st.lists(NAMES, max_size=12))
@example(names=["A1", "A1/run.mf4"])
@example(names=["A1", "A1.json/run.mf4"])
@FEW
def test_no_output_is_that_of_another_or_lies_inside_it(names: list[str]) -> None:
    sources = [Path(f"/data/{at}/x") for at in range(len(names))]
    jobs = [
        Job(s, n, Path("/out")) for s, n in zip(sources, unique_names(names, sources), strict=True)
    ]
    for write in ("profile", "record"):
        places = [folded(getattr(job, write)) for job in jobs]
        assert len(set(places)) == len(places)
        inside = {place[:end] for place in places for end in range(1, len(place))}
        assert not inside & set(places)


@given(data=st.data(), names=st.lists(NAMES, min_size=1, max_size=8))
@FEW
def test_a_name_depends_on_what_there_is_and_not_on_the_order(
    data: st.DataObject, names: list[str]
) -> None:
    pairs = [(name, Path(f"/data/{at}/x")) for at, name in enumerate(names)]

    def named(given: list[tuple[str, Path]]) -> dict[Path, str]:
        found = unique_names([n for n, _ in given], [s for _, s in given])
        return dict(zip((s for _, s in given), found, strict=True))

    assert named(pairs) == named(data.draw(st.permutations(pairs)))


def test_names_that_meet_nobody_stay_and_the_others_keep_their_suffix() -> None:
    sources = [Path("/a/run.mf4"), Path("/b/run.mf4"), Path("/b/other.mf4")]
    first, second, third = unique_names(["run.mf4", "run.mf4", "other.mf4"], sources)
    assert third == "other.mf4"
    for name in (first, second):
        stem, _, tag = name.removesuffix(".mf4").partition("-")
        assert stem == "run"
        assert len(tag) == 8
        assert set(tag) <= set("0123456789abcdef")


def test_a_file_with_the_name_that_a_hash_would_give_does_not_get_lost() -> None:
    sources = [Path("/a/run.mf4"), Path("/b/run.mf4")]
    taken = unique_names(["run.mf4", "run.mf4"], sources)[0]
    for order in permutations(
        [("run.mf4", sources[0]), ("run.mf4", sources[1]), (taken, Path("/c/x"))]
    ):
        assert len(set(unique_names([n for n, _ in order], [s for _, s in order]))) == 3


@pytest.mark.parametrize("part", ["x" * 255, "ü" * 127 + ".mf4", "run." + "y" * 250])
def test_two_long_names_that_begin_alike_stay_two(part: str) -> None:
    base = Path("/data")
    names = {name_below(base / part, base), name_below(base / (part[:-1] + "z"), base)}
    assert len(names) == 2
