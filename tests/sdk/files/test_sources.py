"""A place is named once, however many of those that an error passes know it."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError, one_line
from floatref.files.sources import name_errors


@given(st.text(), st.text(), st.integers(1, 3))
def test_a_place_is_named_once(where: str, said: str, times: int) -> None:
    def within(left: int) -> None:
        if not left:
            raise InputError(said)
        with name_errors(where):
            within(left - 1)

    with pytest.raises(InputError) as caught:
        within(times)
    text = one_line(said)
    named = text if text.startswith(one_line(f"{where}: ")) else one_line(f"{where}: {text}")
    assert str(caught.value) == named


def test_places_around_each_other_are_all_named() -> None:
    with (
        pytest.raises(InputError, match=r"^list: line 2: a\.csv: no$"),
        name_errors("list"),
        name_errors("line 2"),
        name_errors("a.csv"),
    ):
        raise InputError("no")
