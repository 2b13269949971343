"""A bad channel map is refused in one line that says what to do."""

from collections.abc import Callable
from pathlib import Path

import pytest

from floatref.files.toml_document import MOST_PARTS
from floatref.mapping import read_map

HEAD = 'format = "floatref-map/1"\n'
VEHICLE = HEAD + "[setup.vehicle]\nmodel = 'quarter-car'\nparameters.sprung_kg = 700\n"
LASER = '[[channels]]\nnative = "laser"\nchannel = "height"\n'

Save = Callable[[str | bytes], Path]
Refusal = Callable[[Path], str]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "has no format, channels"),
        (b"format = ", "not TOML: "),
        (b"format = 1\nformat = 2", "not TOML: "),
        ((HEAD + LASER).replace("\n", "\r").encode(), "not TOML: "),
        ((HEAD + LASER).encode("utf-16"), "byte 0 is not UTF-8; save the channel map as UTF-8"),
        ((HEAD + LASER).encode("utf-16-le"), "not TOML: "),
        ((HEAD + "# ä\n" + LASER).encode("latin-1"), "byte 28 is not UTF-8"),
        (HEAD + "# \x00\n" + LASER, "not TOML: "),
        (HEAD + "# " + "x" * (2 << 20), "larger than 1 MiB"),
        (HEAD + "x = " + "[" * 100_000, "no channel map (RecursionError)"),
        (HEAD + "x = " + "{a=" * 100_000, "no channel map (RecursionError)"),
        (HEAD + "x = " + "9" * 100_000, "no channel map (ValueError)"),
        (HEAD + "x" + ".y" * 20 + " = 1", "nested too deeply"),
        (HEAD + "x = " + "[" * 40 + "]" * 40, "nested too deeply"),
        (HEAD + LASER + "scale = nan", "channels[0].scale is nan; give a finite number"),
        (HEAD + LASER + "scale = 1e999", "channels[0].scale is inf"),
        (HEAD + LASER + "offset = -inf", "channels[0].offset is -inf"),
        (HEAD + LASER + "wrap = 18446744073709551616", "integer beyond 64 bits"),
        (HEAD + LASER + "delay_s = 2020-01-01", "delay_s is a date or a time"),
        (HEAD + LASER + "delay_s = 07:32:00", "delay_s is a date or a time"),
        (HEAD + 'x."a\\n\\u001b" = nan\n', "x.a\\n\\u001b is nan"),
        ('format = "floatref-map/2"\n' + LASER, 'format is "floatref-map/2"; expected'),
        ('format = "floatref-recording/1"\n' + LASER, "expected"),
        (HEAD + "[channels]\nheight = 'x'", "channels is {"),
        (HEAD + "chanels = []\n" + LASER, 'unknown key "chanels"; did you mean channels?'),
        (HEAD + LASER + "sing = -1", 'unknown key "sing"; did you mean sign?'),
        (HEAD + "[sauce]\n" + LASER, 'unknown key "sauce"; did you mean source?'),
        (HEAD + LASER + 'scale = "2"', 'scale (height) is "2"; expected a number'),
        (HEAD + LASER + "unit = 3", "unit (height) is 3; expected a string"),
        (HEAD + LASER + f'unit = "{"m" * 257}"', "expected a string of at most 256"),
        (HEAD + LASER + "scale = 1e31", "scale (height) is 1e+31; expected a number other than 0"),
        (HEAD + LASER + "scale = 0", "channel height (laser): scale is 0"),
        (HEAD + LASER + "scale = -0.0", "channel height (laser): scale is 0"),
        (HEAD + LASER + "delay_s = 11", "delay_s (height) is 11; expected"),
        (HEAD + LASER + "sparse = 1", "sparse (height) is 1; expected true or false"),
        (HEAD + LASER + LASER, "channel height: mapped twice; keep one entry"),
        (
            HEAD + 2 * (LASER + 'track = "left"\n'),
            "channel height of track left: mapped twice",
        ),
        (HEAD + LASER.replace("height", "heigth"), "channel heigth: unknown name; did you mean"),
        (HEAD + LASER + 'axis = "z"', "axis is z, but height has no axis"),
        (HEAD + LASER + 'file = "gps"', 'file "gps": not in the map\'s files (it has no files)'),
        (HEAD + "[setup]\nprofile_interval_m = 0\n" + LASER, "profile_interval_m is 0; expected"),
        (HEAD + "[setup.vehicle]\nmodel = 'car'\n" + LASER, "setup.vehicle has no parameters"),
        (VEHICLE + "x = 1.7\n" + LASER, 'setup.vehicle has the unknown key "x"; did you mean x_m?'),
        (VEHICLE + "x_m = 1720\n" + LASER, "setup.vehicle.x_m is 1720; expected the model's own"),
        (VEHICLE + "parameters.a = 'b'\n" + LASER, 'parameters.a is "b"; expected a number'),
        (HEAD + "[source]\noptions = { dbc = '/etc/x' }\n" + LASER, "dbc is not an option"),
    ],
)
def test_a_bad_map_is_refused_in_one_line(
    save: Save, refusal: Refusal, content: str | bytes, message: str
) -> None:
    assert message in refusal(save(content))


def test_specific_forces_twice_by_an_axis_are_the_same_channel(
    save: Save, refusal: Refusal
) -> None:
    first = '[[channels]]\nnative = "a"\nchannel = "specific_force"\naxis = "x"\n'
    second = '[[channels]]\nnative = "b"\nchannel = "longitudinal_specific_force"\n'
    assert "longitudinal_specific_force: mapped twice" in refusal(save(HEAD + first + second))


@pytest.mark.parametrize("quote", ["", '"', "'"])
@pytest.mark.parametrize("place", ["{0} = 1", "[{0}]", "x = {{ {0} = 1 }}", "x = [{{ {0} = 1 }}]"])
def test_a_name_of_many_parts_takes_neither_memory_nor_time(
    save: Save, refusal: Refusal, quote: str, place: str
) -> None:
    # A name of 200 000 parts would make the TOML parser hold 2e10 names of its beginnings.
    name = " . ".join([f"{quote}a{quote}"] * 100_000)
    path = save(HEAD + place.format(name))
    assert f"has a name of {MOST_PARTS} parts or more" in refusal(path)


def test_a_file_that_is_none_is_named(refusal: Refusal, tmp_path: Path) -> None:
    assert "check the name" in refusal(tmp_path / "no.toml")
    assert "is a folder" in refusal(tmp_path)


def quoted(name: str) -> str:
    return '"' + name.replace("\\", "\\\\").replace("\0", "\\u0000") + '"'


def with_path(name: str) -> str:
    return f'{HEAD}[[files]]\nname = "more"\npath = {quoted(name)}\n{LASER}'


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("../run.log", "leads out of the map's folder; copy the file there"),
        ("a/../../run.log", "leads out"),
        ("..", "leads out"),
        ("/etc/passwd", "give it relative to the map's folder, with / in between"),
        ("//host/share/x", "give it relative"),
        ("C:/run.log", "give it relative"),
        ("c:run.log", "give it relative"),
        ("..\\run.log", "give it relative"),
        ("\\\\host\\x", "give it relative"),
        ("a\0b", "no possible file name; correct it"),
        ("x" * 300, "no possible file name; correct it"),
        ("", 'is ""; expected a file name'),
        ("x" * 1025, "expected a file name"),
    ],
)
def test_no_path_of_a_map_leaves_its_folder(
    save: Save, refusal: Refusal, name: str, message: str
) -> None:
    assert message in refusal(save(with_path(name)))
    assert message in refusal(save(f"{HEAD}[source]\ndbc = {quoted(name)}\n{LASER}"))


@pytest.mark.posix
def test_a_link_that_leaves_the_folder_is_refused_and_one_that_stays_is_not(
    save: Save, refusal: Refusal, tmp_path: Path
) -> None:
    path = save(with_path("link.log"))
    (tmp_path / "secret").write_bytes(b"")
    (path.parent / "link.log").symlink_to(tmp_path / "secret")
    assert "leads out of the map's folder" in refusal(path)
    (path.parent / "link.log").unlink()
    (path.parent / "real.log").write_bytes(b"")
    (path.parent / "link.log").symlink_to("real.log")
    assert read_map(path).files["more"].path == path.parent.resolve() / "real.log"


@pytest.mark.posix
def test_links_that_go_round_are_refused(save: Save, refusal: Refusal) -> None:
    path = save(with_path("a"))
    (path.parent / "a").symlink_to("b")
    (path.parent / "b").symlink_to("a")
    assert "no possible file name" in refusal(path)


def test_files_are_named_once_and_only_as_they_are_known(save: Save, refusal: Refusal) -> None:
    more = '[[files]]\nname = "m"\npath = "m.log"\n'
    assert "files: m is given twice" in refusal(save(HEAD + more + more + LASER))
    clock = '[[clocks]]\nfile = "n"\nrate_hz = 5\n'
    assert 'file "n": not in the map\'s files (m)' in refusal(save(HEAD + more + clock + LASER))
