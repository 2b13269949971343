"""Formats of profile files: which one a name asks for, which one a file is, and broken ones."""

from pathlib import Path

import numpy as np
import pytest

from floatref import hookimpl
from floatref.engine import formats, plugins
from floatref.engine.formats import format_of, profile_of, write_as
from floatref.engine.recordings import readers, recognising_profiles
from floatref.errors import InputError, PluginError
from floatref.files import write_profile, write_profile_csv
from floatref.values.profile import Profile, ProfileTrack

PROFILE = Profile(0.25, (ProfileTrack.of("left", [0.5, np.nan, 1.5]),), start_m=2.0)


class Mine:
    """A format that holds the interval, and does as it is told."""

    name, suffix, summary = "mine", ".mine", "of a vendor"

    def __init__(self, **attributes):
        vars(self).update(attributes)

    def recognises(self, path):
        return path.suffix == self.suffix

    def read(self, path):
        return Profile(float(path.read_text()), PROFILE.tracks)

    def write(self, profile, path):
        path.write_text(repr(profile.interval_m))


@pytest.fixture
def known(monkeypatch):
    loaded = plugins.Plugins()
    for module in (formats, readers, recognising_profiles):
        monkeypatch.setattr(module, "plugins", lambda: loaded)

    def add(*formats):
        class Vendor:
            @hookimpl
            def floatref_register_profile_formats(self, register):
                for form in formats:
                    register(form)

        loaded.add(Vendor(), "vendor")
        return loaded

    return add


@pytest.mark.parametrize(
    ("out", "name", "expected"),
    [
        ("run", None, "profile"),
        ("stop_0.20g", None, "profile"),
        ("a.CSV", None, "csv"),
        ("a.mine", None, "mine"),
        ("a.csv", "mine", "mine"),
        ("a.xls", "csv", "csv"),
    ],
)
def test_the_name_decides_then_the_suffix(known, out, name, expected):
    known(Mine())
    assert format_of(Path(out), name).name == expected


@pytest.mark.parametrize(
    ("out", "name", "message"),
    [
        ("a.xls", None, r"suffix \.xls is no format; use \.csv, \.mine, .*profile, csv, mine$"),
        ("a", "xls", "format xls: unknown; there are profile, csv, mine"),
    ],
)
def test_what_is_no_format_is_answered_with_those_there_are(known, out, name, message):
    known(Mine())
    with pytest.raises(InputError, match=message):
        format_of(Path(out), name)


def test_a_suffix_of_two_formats_is_not_guessed(known):
    known(Mine(), Mine(name="other"))
    with pytest.raises(InputError, match=r"suffix \.mine is that of mine and other; choose with"):
        format_of(Path("a.mine"))


def test_a_profile_is_read_by_the_format_that_recognises_it(known, tmp_path):
    known(Mine())
    write_as(format_of(tmp_path / "a.mine"), PROFILE, tmp_path / "a.mine")
    write_profile(PROFILE, tmp_path / "folder.mine")
    write_profile_csv(PROFILE, tmp_path / "table.txt")
    assert profile_of(tmp_path / "a.mine").start_m == 0.0
    assert profile_of(tmp_path / "table.txt").start_m == 2.0
    with pytest.raises(InputError, match="formats profile and mine both recognise it"):
        profile_of(tmp_path / "folder.mine")


def test_a_write_that_fails_half_way_leaves_nothing_and_keeps_the_old(known, tmp_path):
    def half(profile, path):
        path.write_text("half")
        raise ZeroDivisionError("of a vendor")

    known(Mine(write=half))
    out = tmp_path / "a.mine"
    out.write_text("old")
    with pytest.raises(PluginError, match=r"format mine: .*a\.mine: ZeroDivisionError: of a"):
        write_as(format_of(out), PROFILE, out, overwrite=True)
    assert [p.name for p in tmp_path.iterdir()] == ["a.mine"]
    assert out.read_text() == "old"


def test_a_refusal_names_the_file_that_was_asked_for(known, tmp_path):
    def refused(profile, path):
        raise InputError(f"{path}: holds one wheel path")

    known(Mine(write=refused))
    out = tmp_path / "a.mine"
    with pytest.raises(InputError, match=rf"^{out}: holds one wheel path$"):
        write_as(format_of(out), PROFILE, out)


def test_a_format_that_writes_nothing_is_named(known, tmp_path):
    known(Mine(write=lambda profile, path: None))
    with pytest.raises(PluginError, match="wrote no file"):
        write_as(format_of(tmp_path / "a.mine"), PROFILE, tmp_path / "a.mine")


@pytest.mark.parametrize(
    ("read", "message"),
    [
        (lambda path: path.nothing, r"format mine: .*a\.mine: AttributeError"),
        (lambda path: None, "gave no profile"),
    ],
)
def test_a_format_that_cannot_read_is_named(known, tmp_path, read, message):
    known(Mine(read=read))
    (tmp_path / "a.mine").touch()
    with pytest.raises(PluginError, match=message):
        profile_of(tmp_path / "a.mine")


def test_a_format_that_cannot_even_recognise_is_reported_and_passed_over(known, tmp_path):
    loaded = known(Mine(recognises=lambda path: 1 / 0))
    write_profile_csv(PROFILE, tmp_path / "a.csv")
    assert profile_of(tmp_path / "a.csv").start_m == 2.0
    assert "ZeroDivisionError" in loaded.reports[0]


@pytest.mark.parametrize("name", ["gone.csv", "a\0b", "x" * 300])
def test_what_cannot_be_opened_is_refused_in_a_line(tmp_path, name):
    with pytest.raises(InputError):
        profile_of(tmp_path / name)


def end(*_):
    raise SystemExit("of a vendor")


def test_a_format_that_would_end_the_program_is_a_failure_of_its_own(known, tmp_path):
    loaded = known(Mine(read=end, write=end), Mine(name="other", suffix=".other", recognises=end))
    path = tmp_path / "a.mine"
    path.touch()
    for use in (profile_of, lambda path: write_as(format_of(path), PROFILE, path, overwrite=True)):
        with pytest.raises(PluginError, match=r"format mine: .*a\.mine: SystemExit: of a vendor"):
            use(path)
    write_profile_csv(PROFILE, tmp_path / "a.csv")
    assert profile_of(tmp_path / "a.csv").start_m == 2.0
    assert "format other: " in loaded.reports[0]
