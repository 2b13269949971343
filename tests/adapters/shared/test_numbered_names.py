"""Names that differ, whatever the file calls its columns."""

from hypothesis import given
from hypothesis import strategies as st

from floatref_adapters.shared.numbered_names import number_repeats

names = st.lists(st.sampled_from(["a", "b", "a #2", "a #3", "a #2 #2", ""]), max_size=9)


@given(names)
def test_all_differ_and_the_first_of_each_keeps_its_name(given_names: list[str]) -> None:
    out = number_repeats(given_names)
    assert len(set(out)) == len(out) == len(given_names)
    for k, name in enumerate(given_names):
        assert out[k].startswith(name)
        if name not in given_names[:k]:
            assert out[k] == name


def test_repeated_names_count_up() -> None:
    assert number_repeats(["v", "v", "t", "v"]) == ["v", "v #2", "t", "v #3"]


def test_one_name_of_very_many_columns_is_numbered_in_turn() -> None:
    """Were every number tried again for each of them, this would take hours."""
    out = number_repeats(["a"] * 200_000)
    assert out[:2] == ["a", "a #2"]
    assert out[-1] == "a #200000"
    assert len(set(out)) == len(out)
