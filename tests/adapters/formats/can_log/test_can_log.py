"""CAN logs: wheel speeds come back by their database, in every format; faults are told."""

from pathlib import Path

import cantools
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.adapters.formats.can_log.files_of_frames import opened

from floatref import Epoch, InputError
from floatref_adapters.formats.can_log.adapter import CanLog
from floatref_adapters.testing.can_log import (
    FAST_ID,
    MULTIPLEXED_ID,
    QUANTUM_KMH,
    WHEELS,
    WHEELS_DBC,
    WHEELS_ID,
    asc_log,
    candump_log,
    wheels_data,
)
from floatref_adapters.testing.whole_reading import read_or_refused, stream_of, table_of

ENDINGS = ("\n", "\r", "\r\n")
counts = st.lists(st.integers(0, 65535), min_size=4, max_size=4)
YEAR_2024_US = 1_704_067_200 * 10**6


@pytest.mark.slow
@settings(deadline=None, max_examples=50)
@given(
    drawn=st.lists(st.tuples(st.integers(1, 10**6), counts), min_size=1, max_size=12),
    form=st.sampled_from(["hex", "dec", "relative", "candump"]),
    ending=st.sampled_from(ENDINGS),
    mark=st.sampled_from(["", "\ufeff"]),
)
def test_every_wheel_speed_comes_back(
    tmp_path_factory: pytest.TempPathFactory,
    drawn: list[tuple[int, list[int]]],
    form: str,
    ending: str,
    mark: str,
) -> None:
    times = np.cumsum([step for step, _ in drawn]).tolist()
    if form == "candump":
        times = [YEAR_2024_US + time for time in times]
    frames = [(time, WHEELS_ID, wheels_data(w)) for time, (_, w) in zip(times, drawn, strict=True)]
    if form == "candump":
        log = candump_log(frames)
    else:
        base = "dec" if form == "dec" else "hex"
        log = asc_log(frames, base, relative=form == "relative")
    content = mark + log.replace("\n", ending)
    file = opened(tmp_path_factory.mktemp("can"), content)
    assert file.warnings == ()
    of = stream_of(file, "WheelSpeeds")
    assert of.clock.epoch is (Epoch.UTC if form == "candump" else Epoch.LOCAL)
    values, ticks = table_of(of)
    assert of.clock.tick_s * 10**9 == 1
    assert ticks.tolist() == [time * 1000 for time in times]
    for k, wheel in enumerate(WHEELS):
        expected = np.array([w[k] for _, w in drawn]) * QUANTUM_KMH
        np.testing.assert_allclose(values[wheel], expected, rtol=1e-12)
    assert {c.name: c.unit for c in of.columns} == dict.fromkeys(WHEELS, "km/h")


@pytest.mark.slow
@settings(deadline=None, max_examples=50)
@given(data=st.binary(min_size=4, max_size=4), wheels=counts)
def test_values_are_those_of_cantools(
    tmp_path_factory: pytest.TempPathFactory, data: bytes, wheels: list[int]
) -> None:
    frames = [(10, WHEELS_ID, wheels_data(wheels)), (20, MULTIPLEXED_ID, data)]
    file = opened(tmp_path_factory.mktemp("can"), asc_log(frames))
    database = cantools.database.load_string(WHEELS_DBC)
    kinds = {0: "Pressure", 1: "Temperature"}
    if data[0] in kinds:
        values, _ = table_of(stream_of(file, "Multiplexed"))
        expected = database.decode_message("Multiplexed", data)
        assert values[kinds[data[0]]][0] == expected[kinds[data[0]]]
        assert np.isnan(values[kinds[1 - data[0]]][0])
    else:
        line = "Multiplexed: 1 frames that are too short or have an unknown multiplexer: dropped"
        assert file.warnings == (line,)
    values, _ = table_of(stream_of(file, "WheelSpeeds"))
    expected = database.decode_message("WheelSpeeds", wheels_data(wheels))
    assert {name: value[0] for name, value in values.items()} == expected


def test_fd_frames_and_extended_ids_are_read(tmp_path: Path) -> None:
    frames = [(10, FAST_ID, bytes(15) + b"\x2a"), (20, MULTIPLEXED_ID, b"\x00\x02\x00\x00")]
    for name, log in (("run.asc", asc_log(frames)), ("run.log", candump_log(frames))):
        file = opened(tmp_path, log, name)
        assert table_of(stream_of(file, "Fast"))[0]["Last"].tolist() == [42]
        assert table_of(stream_of(file, "Multiplexed"))[0]["Pressure"].tolist() == [-39]


def test_a_length_code_above_8_of_a_classic_frame_means_8_bytes(tmp_path: Path) -> None:
    log = asc_log([(100, WHEELS_ID, wheels_data([1, 2, 3, 4]))]).replace(" d 8 ", " d f ")
    assert " d f " in log
    file = opened(tmp_path, log)
    assert (stream_of(file, "WheelSpeeds").count, file.warnings) == (1, ())


def test_without_a_database_every_id_is_listed_with_its_count(tmp_path: Path) -> None:
    frames = [(k, (0x64, 0x7FF, 0x800)[k % 3], bytes(k % 8)) for k in range(1, 12)]
    file = opened(tmp_path, asc_log(frames), dbc=None)
    counts = {s.name: s.count for s in file.streams}
    assert counts == {"0x064": 3, "0x7FF": 4, "0x00000800": 4}
    assert not any(column.numeric for s in file.streams for column in s.columns)
    assert table_of(file.streams[0])[1].tolist() == [3000, 6000, 9000]


def test_several_buses_are_told_apart(tmp_path: Path) -> None:
    frames = [(10, WHEELS_ID, wheels_data([1, 2, 3, 4]))]
    both = asc_log(frames) + asc_log(frames * 2, channel=2).partition("10.0.1\n")[2]
    file = opened(tmp_path, both)
    found = {s.name: s.count for s in file.streams}
    assert found == {"WheelSpeeds bus 1": 1, "WheelSpeeds bus 2": 2}


def test_what_is_no_data_frame_is_told(tmp_path: Path) -> None:
    frame = asc_log([(10, WHEELS_ID, wheels_data([1, 2, 3, 4]))])
    lines = [
        "   0.000020 1  ErrorFrame",
        "   0.000030 1  4B0             Rx   r",
        "   0.000040 1  OverloadFrame",
        "   0.000050 1  Statistic: D 0 R 0 XD 0 XR 0 E 0 O 0 B 0.00%",
        "   0.000060 1  Wheels          Rx   d 8 00 00 00 00 00 00 00 00",
        "   0.000070 1  4B0             Rx   d 8 00 00",
        "   0.000080 1  4B0             Rx   d 2 00 00",
        "   0.000090 1  FFF             Rx   d 0",
        "   0.000100 1  123             Rx   d 1 00",
        "   0.000005 1  4B0             Rx   d 8 00 00 00 00 00 00 00 00",
    ]
    file = opened(tmp_path, frame + "\n".join(lines))
    assert stream_of(file, "WheelSpeeds").count == 2
    assert set(file.warnings) == {
        "1 error frames: not read",
        "1 remote frames: not read",
        "1 overload frames: not read",
        "1 events that are no data frames: not read",
        "1 lines that python-can cannot read: dropped",
        "1 frames with fewer bytes than they declare: dropped",
        "1 frames with an id or a time that cannot be: dropped",
        "1 times the time goes back",
        "WheelSpeeds: 1 frames that are too short or have an unknown multiplexer: dropped",
        "1 frames of 1 ids not in the database: not decoded (0x123)",
    }


def test_a_log_without_the_line_that_ends_its_header_keeps_its_first_frame(tmp_path: Path) -> None:
    frames = [(k, WHEELS_ID, wheels_data([k, 0, 0, 0])) for k in (10, 20)]
    log = asc_log(frames).replace("internal events logged\n", "")
    values, ticks = table_of(stream_of(opened(tmp_path, log), "WheelSpeeds"))
    assert ticks.tolist() == [10_000, 20_000]
    assert values["FrontLeft"].tolist() == [0.1, 0.2]


@pytest.mark.parametrize(
    ("dbc", "reason"),
    [
        ("BO_ wheels", "no CAN database that cantools reads"),
        ("<xml", "no CAN database that cantools reads"),
        ("", "no CAN database that cantools reads"),
    ],
)
def test_a_bad_database_is_refused_in_one_line(tmp_path: Path, dbc: str, reason: str) -> None:
    log = asc_log([(10, WHEELS_ID, bytes(8))])
    with pytest.raises(InputError, match=reason) as caught:
        opened(tmp_path, log, dbc=dbc)
    assert "\n" not in str(caught.value)
    assert "bus.dbc" in str(caught.value)


def test_a_missing_database_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "run.asc"
    path.write_text(asc_log([(10, WHEELS_ID, bytes(8))]))
    for dbc in (tmp_path / "none.dbc", tmp_path):
        with pytest.raises(InputError, match="give the path of a DBC in option dbc"):
            CanLog().streams(path, {"dbc": str(dbc)})


@settings(deadline=None, max_examples=40)
@given(data=st.data())
def test_mutated_databases_are_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    text = WHEELS_DBC
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(text)))
        gone = data.draw(st.integers(0, 12))
        text = (
            text[:at] + data.draw(st.text('0123 |@+-()"[]MmSGBO_é', max_size=6)) + text[at + gone :]
        )
    folder = tmp_path_factory.mktemp("mutated")
    (folder / "run.asc").write_text(asc_log([(10, WHEELS_ID, wheels_data([1, 2, 3, 4]))]))
    (folder / "bus.dbc").write_text(text, encoding="cp1252")
    read_or_refused(CanLog(), folder / "run.asc", {"dbc": str(folder / "bus.dbc")})
