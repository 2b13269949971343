"""The door to files: kind and length are those of what was opened; a place is named once.

Law: what is no plain file is refused in one line, without waiting for it; of a file as many bytes
are read as it had when it was opened.
"""

import os
import socket
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError, one_line
from floatref.files import sources
from floatref.files.sources import (
    check_file,
    check_source,
    name_errors,
    open_bytes,
    read_bytes,
    read_start,
    real_path,
)

pytestmark = pytest.mark.posix


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


@pytest.fixture(params=["pipe", "socket", "folder", "device", "zero", "loop", "chain", "missing"])
def no_file(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """Make something that is no plain file."""
    path = tmp_path / "in place of a file"
    if request.param == "pipe":
        os.mkfifo(path)
    elif request.param == "socket":
        monkey = request.getfixturevalue("monkeypatch")
        # The name of a socket may be short only.
        monkey.chdir(tmp_path)
        with socket.socket(socket.AF_UNIX) as bound:
            bound.bind(path.name)
    elif request.param == "folder":
        path.mkdir()
    elif request.param == "loop":
        path.symlink_to(path)
    elif request.param == "chain":
        path.symlink_to(tmp_path / "gone")
    elif request.param != "missing":
        path = Path("/dev/null" if request.param == "device" else "/dev/zero")
    return path


def test_what_is_no_file_is_refused_in_one_line(no_file: Path) -> None:
    for read in (check_file, lambda path: read_bytes(path, 10, "list")):
        with pytest.raises(InputError) as caught:
            read(no_file)
        assert str(caught.value).startswith(f"{no_file}: ")
        assert "; " in str(caught.value)
    assert read_start(no_file, 10) == b""


def test_a_pipe_that_takes_the_place_of_a_file_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file, pipe = tmp_path / "file", tmp_path / "pipe"
    file.write_bytes(b"x")
    os.mkfifo(pipe)
    # Whoever looks before it is opened sees a file.
    looked = os.stat(file)
    with monkeypatch.context() as patched:
        patched.setattr(sources.os, "stat", lambda _: looked)
        with pytest.raises(InputError, match="pipe: is a device or pipe"):
            check_file(pipe)


def test_a_folder_is_a_source_and_a_pipe_is_not(tmp_path: Path) -> None:
    assert check_source(tmp_path) == tmp_path
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match="is a device or pipe"):
        check_source(tmp_path / "pipe")


@given(
    content=st.binary(max_size=300), more=st.binary(min_size=1), reads=st.lists(st.integers(-1, 99))
)
def test_what_is_appended_while_it_is_read_is_left_out(
    tmp_path_factory: pytest.TempPathFactory, content: bytes, more: bytes, reads: list[int]
) -> None:
    path = tmp_path_factory.mktemp("file") / "growing"
    path.write_bytes(content)
    with open_bytes(path) as stream:
        with path.open("ab") as end:
            end.write(more)
        found = b"".join(stream.read(size) for size in reads)
        assert found + stream.read() == content


@given(content=st.binary(max_size=300), pieces=st.lists(st.binary(max_size=90), max_size=4))
def test_a_file_that_grows_is_read_as_far_as_it_has_grown(
    tmp_path_factory: pytest.TempPathFactory, content: bytes, pieces: list[bytes]
) -> None:
    path = tmp_path_factory.mktemp("file") / "growing"
    path.write_bytes(content)
    with open_bytes(path, grows=True) as stream:
        found = stream.read()
        for piece in pieces:
            with path.open("ab") as end:
                end.write(piece)
            found += stream.read1()
        assert found + stream.read() == content + b"".join(pieces)


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="needs files without a length")
def test_a_file_without_a_length_is_empty() -> None:
    assert read_bytes(Path("/proc/self/maps"), 1 << 20, "list") == b""


@given(content=st.binary(max_size=40), most=st.integers(0, 40))
def test_a_file_longer_than_its_limit_is_refused(
    tmp_path_factory: pytest.TempPathFactory, content: bytes, most: int
) -> None:
    path = tmp_path_factory.mktemp("file") / "file"
    path.write_bytes(content)
    if len(content) <= most:
        assert read_bytes(path, most, "list") == content
        return
    with pytest.raises(InputError, match="file: larger than any list"):
        read_bytes(path, most, "list")


def test_a_link_is_followed_unless_another_may_have_put_it_there(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"x")
    link = tmp_path / "link"
    link.symlink_to("file")
    assert read_bytes(link, 1, "list") == b"x"
    with pytest.raises(InputError, match="link: "):
        read_bytes(link, 1, "list", links=False)


def test_a_loop_of_links_has_a_path(tmp_path: Path) -> None:
    loop = tmp_path / "loop"
    loop.symlink_to(loop)
    assert real_path(loop / "x").name == "x"
