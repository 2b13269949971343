"""A name in a map means one column, or the refusal says which names there are."""

from contextlib import suppress

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping.channel_map.column_names import MOST, find, full_name
from floatref.values.native import Column, NativeClock, NativeFile, Stream


def native(**streams: list[str | Column]) -> NativeFile:
    """Return a file with ``streams`` of columns; `_` stands for a stream without a name."""
    return NativeFile(
        tuple(
            Stream(
                "" if name == "_" else name,
                tuple(c if isinstance(c, Column) else Column(c) for c in columns),
                *(0, NativeClock(), lambda names: iter(())),
            )
            for name, columns in streams.items()
        )
    )


def where(file: NativeFile, name: str) -> tuple[str, str]:
    stream, column = find(file, name)
    return stream.name, column.name


FILE = native(adc=["z", "t"], gps=["t", "alt"], _=["dmi", "gps/alt"])


@pytest.mark.parametrize(
    ("name", "place"),
    [
        ("adc/z", ("adc", "z")),
        ("z", ("adc", "z")),
        ("adc/t", ("adc", "t")),
        ("gps/t", ("gps", "t")),
        ("alt", ("gps", "alt")),
        ("dmi", ("", "dmi")),
    ],
)
def test_a_full_name_or_one_that_is_there_once_is_found(name: str, place: tuple[str, str]) -> None:
    assert where(FILE, name) == place


def test_a_full_name_counts_before_the_name_of_a_column() -> None:
    assert where(native(a=["b/c"], b=["c"]), "b/c") == ("b", "c")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("t", "'t' is in 2 streams; write one of adc/t, gps/t"),
        ("gps/alt", "'gps/alt' is in 2 streams; rename one of them"),
        ("adc/q", "'adc/q' is not in the file; did you mean adc/"),
        ("gsp/alt", "did you mean gps/alt?"),
        ("dmj", "did you mean dmi?"),
        ("", "'' is not in the file; there are adc/z, adc/t, gps/t, gps/alt, dmi, gps/alt"),
    ],
)
def test_a_name_that_means_none_or_several_is_refused(name: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        find(FILE, name)
    assert message in str(caught.value)


def test_a_column_of_text_cannot_be_mapped() -> None:
    file = native(s=[Column("a", numeric=False), Column("b", note="names", numeric=False)])
    for name, why in (("a", "text"), ("s/b", "names")):
        with pytest.raises(InputError, match=rf"holds no numbers \({why}\); map another"):
            find(file, name)


def test_a_file_without_columns_says_so() -> None:
    for file in (native(), native(s=[])):
        with pytest.raises(InputError, match="'x' is not in the file; it has no columns"):
            find(file, "x")


def test_of_very_many_names_a_few_are_listed() -> None:
    file = native(s=[f"{n:x}" for n in range(3 * MOST)])
    with pytest.raises(InputError, match=r"there are s/0, .*, s/7 and 12280 more") as caught:
        find(file, "ÄÖÜ")
    assert len(str(caught.value)) < 200


names = st.text(st.sampled_from("ab/\n\x1b\u2028 "), max_size=4)


@settings(deadline=None, max_examples=100)
@given(streams=st.dictionaries(names, st.sets(names, max_size=4), max_size=4), wanted=names)
def test_every_column_is_found_by_its_full_name_unless_another_has_it(
    streams: dict[str, set[str]], wanted: str
) -> None:
    file = NativeFile(
        tuple(
            Stream(name, tuple(map(Column, columns)), 0, NativeClock(), lambda names: iter(()))
            for name, columns in streams.items()
        )
    )
    places = [(stream, column) for stream in file.streams for column in stream.columns]
    full = [full_name(*place) for place in places]
    for place, name in zip(places, full, strict=True):
        if full.count(name) == 1:
            assert find(file, name) == place
        else:
            with pytest.raises(InputError, match="streams; "):
                find(file, name)
    with suppress(InputError):
        stream, column = find(file, wanted)
        assert wanted in (column.name, full_name(stream, column))


def test_what_was_lost_of_a_file_is_said_of_a_name_that_is_not_there() -> None:
    native = NativeFile((), warnings=("the last segment is\ncut off", "b", "c", "d"))
    with pytest.raises(InputError) as caught:
        find(native, "DMI")
    assert str(caught.value).endswith("(of the file: the last segment is\\ncut off; b; c)")
    assert str(caught.value).isprintable()
