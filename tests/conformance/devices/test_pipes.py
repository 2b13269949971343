"""Lines, tail and feed of a pipe, whatever the chunks in which it is read."""

import os
from io import FileIO
from threading import Thread

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.devices.pipes import MAX_LINE, MAX_OUTPUT, TAIL_BYTES, Feed, Lines, Tail


class Pipe:
    """Both ends of a pipe; what is written to it is written by a thread."""

    def __init__(self, *chunks):
        out, into = os.pipe()
        self.out, self.into = FileIO(out, "r"), FileIO(into, "w")
        self.writer = Thread(target=self._write, args=(chunks,), daemon=True)
        self.writer.start()

    def _write(self, chunks):
        try:
            for chunk in chunks:
                while chunk:
                    chunk = chunk[self.into.write(chunk) :]
        except BrokenPipeError:
            pass
        self.into.close()

    def all_of(self, lines):
        taken = list(iter(lambda: lines.take(30.0), None))
        lines.thread.join()
        self.out.close()
        self.writer.join()
        return taken


WRITTEN = st.binary(max_size=300).map(lambda b: b.replace(b"x", b"\n"))


@settings(deadline=None, max_examples=30)
@given(st.lists(WRITTEN, max_size=8))
def test_lines_are_what_was_written_however_it_was_cut(chunks):
    pipe = Pipe(*chunks)
    lines = Lines(pipe.out)
    taken = pipe.all_of(lines)
    assert b"\n".join([*taken, lines.rest]) == b"".join(chunks)
    assert not lines.fault


@pytest.mark.parametrize(("length", "is_fault"), [(MAX_LINE, False), (MAX_LINE + 1, True)])
@pytest.mark.parametrize("end", [b"\n", b""])
def test_a_line_is_a_mebibyte_at_most_ended_or_not(length, is_fault, end):
    pipe = Pipe(b"y" * length + end)
    lines = Lines(pipe.out)
    taken = pipe.all_of(lines)
    assert bool(lines.fault) is is_fault
    assert len(taken) == (end == b"\n" and not is_fault)


def test_lines_before_one_that_is_too_long_are_kept():
    pipe = Pipe(b"first\nsecond\n" + b"y" * (MAX_LINE + 1) + b"\nthird\n")
    lines = Lines(pipe.out)
    assert pipe.all_of(lines) == [b"first", b"second"]
    assert "longer than 1 MiB" in lines.fault


def test_what_is_written_in_all_is_bounded_even_if_every_line_is_taken():
    out, into = os.pipe()
    with open(out, "rb", buffering=0) as reader, open(into, "wb") as writer:
        lines = Lines(reader)
        for _ in range(MAX_OUTPUT // MAX_LINE):
            writer.write(b"y" * (MAX_LINE - 1) + b"\n")
            writer.flush()
            assert len(lines.take(30.0)) == MAX_LINE - 1
        assert not lines.ended
        writer.write(b"y")
        writer.flush()
        lines.thread.join()
    assert lines.fault == "wrote more than 64 MiB"


def test_a_flood_of_lines_that_nobody_takes_is_read_no_further():
    pipe = Pipe(*[b"y" * 999 + b"\n"] * 10_000)
    lines = Lines(pipe.out)
    lines.thread.join()
    assert lines.fault == "wrote more than 2 MiB for one command"
    assert set(pipe.all_of(lines)) == {b"y" * 999}


@settings(deadline=None, max_examples=20)
@given(st.lists(st.integers(1, 3 * TAIL_BYTES), max_size=3))
def test_the_tail_is_the_end_of_what_was_written(lengths):
    chunks = [bytes(n % 251 for n in range(length)) for length in lengths]
    pipe = Pipe(*chunks)
    tail = Tail(pipe.out)
    tail.thread.join()
    assert tail.end == b"".join(chunks)[-TAIL_BYTES:]
    pipe.out.close()


def test_a_feed_does_not_wait_for_its_reader_and_writes_all_once_it_reads():
    out, into = os.pipe()
    feed = Feed(FileIO(into, "w"))
    lines = [bytes([65 + n]) * 200_000 for n in range(5)]
    for line in lines:
        feed.put(line)
    feed.close()
    with open(out, "rb") as reader:
        assert reader.read() == b"".join(lines)
    feed.thread.join()


def test_a_feed_whose_reader_is_gone_is_no_error():
    out, into = os.pipe()
    os.close(out)
    stream = FileIO(into, "w")
    feed = Feed(stream)
    feed.put(b"to nobody\n")
    feed.thread.join(30.0)
    assert not feed.thread.is_alive()
    stream.close()
