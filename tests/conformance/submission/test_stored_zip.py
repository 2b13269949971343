"""The archive: one content has one sequence of bytes, and anything else is refused by its name."""

import io
import stat
import warnings
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile, ZipInfo

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.submission import stored_zip
from floatref_conformance.submission.checksums import SUMS, compare_sums, list_sums
from floatref_conformance.submission.stored_zip import DATE, MODE, read_archive, write_archive

NAMES = st.from_regex(r"[a-z0-9]{1,4}(/[a-z0-9]{1,4}){0,2}", fullmatch=True)
MEMBERS = st.dictionaries(NAMES, st.binary(max_size=40), max_size=5)


def member(name, mode=MODE, date=DATE, kind=ZIP_STORED):
    info = ZipInfo(name, date)
    info.external_attr, info.create_system, info.compress_type = mode << 16, 3, kind
    return info


def pack(*members, comment=b""):
    """Return a zip of pairs of `member` and content, whatever they are."""
    stream = io.BytesIO()
    with warnings.catch_warnings(), ZipFile(stream, "w") as archive:
        warnings.simplefilter("ignore", UserWarning)
        for info, content in members:
            archive.writestr(info, content)
        archive.comment = comment
    return stream.getvalue()


GOOD = pack((member("a"), b"one"), (member("b"), b"two"))
DIRECTORY = GOOD.index(b"PK\x01\x02")
NAMELESS = bytearray(GOOD)
NAMELESS[30] = NAMELESS[DIRECTORY + 46] = 0
"""Its first name ends before its first letter."""
LINK, FOLDER = stat.S_IFLNK | 0o777, stat.S_IFDIR | 0o755
REFUSED = {
    "cut at its end": (GOOD[:-30], "not a whole archive"),
    "cut in a member": (GOOD[:31] + GOOD[33:], "a: other bytes lie before it"),
    "a byte of a member": (GOOD.replace(b"one", b"onf"), "CRC"),
    "no archive": (b"floatref", "not a whole archive"),
    "empty": (b"", "not a whole archive"),
    "a path that leads out": (pack((member("../a"), b"")), "../a: is a path"),
    "a path from the root": (pack((member("/etc/passwd"), b"")), "/etc/passwd: is a path"),
    "a path of Windows": (pack((member("..\\a"), b"")), "is a path"),
    "a drive": (pack((member("C:a"), b"")), "C:a: is a path"),
    "no name": (bytes(NAMELESS), "is a path"),
    "a hidden name": (pack((member("a/.git"), b"")), "a/.git: is a path"),
    "a link": (pack((member("a", LINK), b"/etc/passwd")), "a: is a link"),
    "a folder": (pack((member("a/", FOLDER), b"")), "a/: is a folder"),
    "a name twice": (pack((member("a"), b"1"), (member("a"), b"2")), "a: 2 members"),
    "a name in two cases": (pack((member("A"), b"1"), (member("a"), b"2")), "a: 2 members"),
    "a bomb": (pack((member("a", kind=ZIP_DEFLATED), bytes(10**6))), "a: is compressed"),
    "an executable": (pack((member("a", stat.S_IFREG | 0o755), b"")), "a: has another mode"),
    "another date": (pack((member("a", date=(2020, 1, 1, 0, 0, 0)), b"")), "a: has a date"),
    "another order": (pack((member("b"), b""), (member("a"), b"")), "bytes"),
    "a comment": (pack((member("a"), b""), comment=b"hidden"), "bytes, its members make"),
    "bytes before it": (b"#!/bin/sh\n" + GOOD, "a: other bytes lie before it"),
    "bytes in it": (GOOD[:DIRECTORY] + b"x" + GOOD[DIRECTORY:], ""),
    "encrypted": (GOOD[: DIRECTORY + 8] + b"\1" + GOOD[DIRECTORY + 9 :], "a: is encrypted"),
}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "a.zip"


@pytest.mark.parametrize("kind", REFUSED)
def test_what_we_do_not_write_is_refused_in_one_line(path, kind):
    content, text = REFUSED[kind]
    path.write_bytes(content)
    with pytest.raises(InputError) as refused:
        read_archive(path)
    assert text in str(refused.value)
    assert str(refused.value).startswith(f"{path}: ")
    assert "\n" not in str(refused.value)


def test_a_good_one_is_read(path):
    path.write_bytes(GOOD)
    assert read_archive(path) == {"a": b"one", "b": b"two"}


def test_a_link_to_an_archive_may_be_given_and_a_folder_not(path):
    path.mkdir()
    with pytest.raises(InputError, match="is a folder"):
        read_archive(path)


@pytest.fixture(scope="module")
def one_folder(tmp_path_factory):
    return tmp_path_factory.mktemp("zips")


def write_anew(members, path):
    """Write ``members`` and return the bytes; an old file would be flushed to the disk first."""
    path.unlink(missing_ok=True)
    write_archive(members, path)
    return path.read_bytes()


@settings(max_examples=20, deadline=None)
@given(MEMBERS)
def test_content_comes_back_and_bytes_follow_from_it(one_folder, members):
    path = one_folder / "a.zip"
    turned = write_anew(dict(reversed(members.items())), path)
    assert write_anew(members, path) == turned
    assert read_archive(path) == members


@settings(max_examples=50, deadline=None)
@given(st.data())
def test_no_changed_byte_changes_a_member_unnoticed(one_folder, data):
    members = {"a": b"one", "b/c": b"two"}
    members[SUMS] = list_sums(members)
    path = one_folder / "b.zip"
    content = bytearray(write_anew(members, path))
    place = data.draw(st.integers(0, len(content) - 1))
    content[place] ^= data.draw(st.integers(1, 255))
    path.write_bytes(content)
    try:
        found = read_archive(path)
    except InputError:
        return
    assert found == members or list(compare_sums(found, frozenset()))


def test_a_target_that_exists_stays(path):
    path.write_bytes(b"mine")
    with pytest.raises(InputError, match="exists"):
        write_archive({"a": b""}, path)
    assert path.read_bytes() == b"mine"
    assert [p.name for p in path.parent.iterdir()] == ["a.zip"]


def test_more_than_can_be_read_is_not_written(path, monkeypatch):
    monkeypatch.setattr(stored_zip, "MOST_MEMBERS", 1)
    with pytest.raises(InputError, match="too large"):
        write_archive({"a": b"", "b": b""}, path)
    monkeypatch.setattr(stored_zip, "MOST_MEMBERS", 2)
    write_archive({"a": b"", "b": b""}, path)
    monkeypatch.setattr(stored_zip, "MOST_MEMBERS", 1)
    with pytest.raises(InputError, match="2 members"):
        read_archive(Path(path))
