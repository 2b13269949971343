"""Names are in the order in which people count."""

from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from floatref.batch.jobs.natural_order import natural_key, natural_path_key

NAMES = st.text(st.sampled_from("ab-. 0123456789"), max_size=12)


@given(st.text("abc-_. ", max_size=5), st.text("abc-_. ", max_size=5), st.lists(st.integers(0)))
def test_numbers_go_by_value(before: str, after: str, numbers: list[int]) -> None:
    names = [f"{before}{number}{after}" for number in numbers]
    expected = [f"{before}{number}{after}" for number in sorted(numbers)]
    assert sorted(names, key=natural_key) == expected


@given(st.lists(NAMES, unique=True), st.randoms())
def test_no_two_names_are_equal(names: list[str], random) -> None:
    shuffled = random.sample(names, len(names))
    assert sorted(names, key=natural_key) == sorted(shuffled, key=natural_key)
    assert len({natural_key(name) for name in names}) == len(names)


@given(st.lists(st.text("abcxyz-_.", max_size=6)))
def test_names_without_numbers_are_in_the_order_of_their_letters(names: list[str]) -> None:
    assert sorted(names, key=natural_key) == sorted(names)


def test_runs_roads_and_thousands_of_digits() -> None:
    paths = [Path(name) for name in ("a/run-10.mf4", "a/run-9.mf4", "a10/run-1", "a9/run-2", "a")]
    ordered = [path.as_posix() for path in sorted(paths, key=natural_path_key)]
    assert ordered == ["a", "a/run-9.mf4", "a/run-10.mf4", "a9/run-2", "a10/run-1"]
    assert sorted(["run-010", "run-9", "run-10"], key=natural_key) == ["run-9", "run-010", "run-10"]
    natural_key("9" * 10_000)
