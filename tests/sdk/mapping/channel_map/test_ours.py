"""A file whose channels have our names needs no map."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.files import read_schema
from floatref.files.schema import enforce
from floatref.mapping import read_native
from floatref.mapping.channel_map.column_names import channel_of, map_of_ours
from floatref.values.channels import CHANNELS
from floatref.values.native import Column, NativeClock, NativeFile, Stream

RUN = Path("my run.mf4")


def file(*columns: Column, name: str = "") -> NativeFile:
    return NativeFile((Stream(name, columns, 0, NativeClock(), lambda names: iter(())),))


@pytest.mark.parametrize("channel", CHANNELS)
def test_a_channel_is_known_by_its_name_with_or_without_a_track(channel: str) -> None:
    assert channel_of(Column(channel)) == (channel, None)
    assert channel_of(Column(f"left.{channel}")) == (channel, "left")
    assert channel_of(Column(f"lane 2.outer.{channel}")) == (channel, "lane 2.outer")


@pytest.mark.parametrize(
    "name",
    [
        *("Height", "heights", "height.left", "left/height", ".height", "left.", ""),
        *("../x.height", "a/b.height", "a\\b.height", "a\n.height", "C:.height", "a*.height"),
        "x" * 49 + ".height",
        "\udc80.height",
    ],
)
def test_what_is_no_channel_or_no_track_is_not_ours(name: str) -> None:
    assert channel_of(Column(name)) is None


def test_text_is_no_channel() -> None:
    assert channel_of(Column("height", numeric=False)) is None


@pytest.mark.slow
@settings(deadline=None, max_examples=200)
@given(track=st.text(st.one_of(st.characters(), st.sampled_from('./\\:*?"<>|')), max_size=50))
def test_a_track_is_ours_if_and_only_if_the_schema_has_it(track: str) -> None:
    document = {
        "format": "floatref-map/1",
        "channels": [{"native": "x", "channel": "height", "track": track}],
    }
    try:
        enforce(document, "floatref-map-1", "map")
        allowed = True
    except InputError:
        allowed = False
    assert (channel_of(Column(f"{track}.height")) == ("height", track)) == allowed
    assert read_schema("floatref-map-1")["$defs"]["track"]["maxLength"] == 48


def test_the_units_of_the_file_count_and_none_is_ours() -> None:
    chart = map_of_ours(file(Column("left.height", "mm"), Column("distance"), Column("spare")), RUN)
    assert [(e.native, e.channel, e.track, e.unit) for e in chart.channels] == [
        ("left.height", "height", "left", "mm"),
        ("distance", "distance", None, "m"),
    ]


def test_a_file_of_other_names_is_told_how_to_go_on() -> None:
    """The command is one to be copied: it names the file, also one with a space in its name."""
    with pytest.raises(InputError, match=r"`floatref channels 'my run.mf4' --draft-map`"):
        map_of_ours(file(Column("Laser"), Column("DMI")), RUN)


def test_two_of_one_channel_are_refused() -> None:
    both = NativeFile(file(Column("height"), name="a").streams + file(Column("height")).streams)
    with pytest.raises(InputError, match="height: its channel is there twice; choose one"):
        map_of_ours(both, RUN)


def test_units_are_converted_without_a_map(put: Callable[..., Path], make_stream, a_drive) -> None:
    run = a_drive(2.0)
    native = {"height": 1e3 * run["height"], "distance": run["distance"]}
    units = {"height": "mm", "distance": ""}
    reading = read_native(put(make_stream("s", native, units, rate=Fraction(1000))))
    np.testing.assert_allclose(
        reading.recording.channel("height").values, run["height"], rtol=1e-14
    )
    assert reading.origins == ("s/height", "s/distance")
