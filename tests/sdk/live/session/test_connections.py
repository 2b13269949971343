"""Peers at a port: who is let in, and a peer that goes away and comes back."""

import json
import socket
import threading
from contextlib import contextmanager
from io import BytesIO

import numpy as np
import pytest

from floatref import InputError, read_profile
from floatref.live.as_live import run_as_live
from floatref.live.session import serving
from floatref.live.session.connections import is_loopback, read_token, serve_connections
from floatref.live.session.json_lines import read_json_lines
from floatref.live.session.live_run import LiveRun

LEGS = [(20.0, 250.0)]
TOKEN = "correct horse battery"
WAIT_S = 120.0


@pytest.fixture(scope="module")
def messages(drive, live):
    return live.messages_of(drive(LEGS), step_s=10.0)


@pytest.fixture(scope="module")
def expected(drive, live):
    return run_as_live(drive(LEGS), live.PIPELINE).profile


@contextmanager
def served(path, token=""):
    """Serve a run in a thread; yield its port, the lines about peers, and the errors at the end."""
    ports, lines, errors = [], [], []
    listening = threading.Event()

    def announce(text):
        ports.append(int(text.rpartition(":")[2]))
        listening.set()

    def work():
        run = LiveRun(path, False)
        try:
            serve_connections(run, "127.0.0.1", 0, token, announce, lines.append)
        except InputError as error:
            errors.append(error)
        finally:
            run.close()

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    assert listening.wait(WAIT_S)
    yield ports[0], lines, errors
    thread.join(WAIT_S)
    assert not thread.is_alive()


def talk(port, data, ends=True):
    """Send ``data`` and return the answers, read after all was sent."""
    with socket.create_connection(("127.0.0.1", port), timeout=WAIT_S) as connection:
        connection.sendall(data)
        if ends:
            connection.shutdown(socket.SHUT_WR)
        with connection.makefile("rb") as stream:
            return [json.loads(line) for line in stream]


@pytest.mark.slow
def test_a_peer_that_comes_back_completes_the_run(messages, expected, live, same, tmp_path):
    hello, *pieces, finish = messages
    with served(tmp_path / "run") as (port, lines, errors):
        first = talk(port, live.as_lines([hello, *pieces[:15]]))
        again = talk(port, live.as_lines([hello, *pieces[10:], finish]))
    assert not errors
    assert first[-1]["kind"] == "saved"
    assert again[0]["next"] == first[-1]["next"]
    assert again[-1]["kind"] == "finished"
    assert ["ended without the message finish" in line for line in lines] == [True]
    same(read_profile(tmp_path / "run"), expected)


@pytest.mark.slow
def test_only_a_peer_with_the_token_is_let_in(messages, live, tmp_path):
    hello, *pieces, finish = messages
    with served(tmp_path / "run", TOKEN) as (port, lines, errors):
        for token in ({}, {"token": ""}, {"token": TOKEN[:-1]}, {"token": TOKEN + "é"}):
            (answer,) = talk(port, live.as_lines([{**hello, **token}, *pieces]))
            assert answer["kind"] == "refused"
            assert answer["text"].startswith("line 1: token is not that of this server")
        assert not (tmp_path / "run").exists()
        assert talk(port, b"GET / HTTP/1.1\r\n\r\n")[0]["kind"] == "refused"
        found = talk(port, live.as_lines([{**hello, "token": TOKEN}, *pieces, finish]))
    assert not errors
    assert len(lines) == 5
    assert found[-1]["kind"] == "finished"
    text = (tmp_path / "run" / "profile.json").read_text(encoding="utf-8")
    assert TOKEN not in text


def test_a_message_that_cannot_be_used_ends_the_run(messages, live, tmp_path):
    hello, *pieces, _ = messages
    odd = {"kind": "samples", "channels": {"left.height": {"values": [0.3, "x"]}}}
    with served(tmp_path / "run") as (port, _, errors):
        found = talk(port, live.as_lines([hello, pieces[0], odd, pieces[1]]))
    line = 'line 3: channels.left.height.values[1] is "x"; expected a number, or null'
    assert found[-1]["text"].startswith(line)
    assert [str(error).startswith(line) for error in errors] == [True]
    assert (tmp_path / "run" / "live.json").exists()


def end(port, live, hello):
    """End the run with a message that cannot be used."""
    assert talk(port, live.as_lines([hello, {"kind": "none"}]))[-1]["kind"] == "refused"


@pytest.mark.posix
def test_the_port_is_open_at_the_address_of_the_host_alone(messages, live, tmp_path):
    with served(tmp_path / "run") as (port, _, _):
        with pytest.raises(OSError, match=r"refused|timed out|assign"):
            socket.create_connection(("127.0.0.2", port), timeout=5.0)
        end(port, live, messages[0])


def test_a_peer_that_sends_no_hello_holds_the_port_for_a_time(
    messages, live, tmp_path, monkeypatch
):
    monkeypatch.setattr(serving, "HELLO_S", 0.3)
    with served(tmp_path / "run") as (port, lines, _):
        (answer,) = talk(port, b"", ends=False)
        assert answer["text"].startswith("no hello within 0.3 s; send one first")
        assert len(lines) == 1
        monkeypatch.setattr(serving, "HELLO_S", WAIT_S)
        end(port, live, messages[0])


def test_a_line_without_an_end_is_not_read_to_its_end():
    line = BytesIO(b"x" * ((16 << 20) + 100))
    with pytest.raises(InputError, match="line 1: longer than 16 MiB; send fewer samples"):
        next(read_json_lines(line))
    assert line.tell() == (16 << 20) + 1


@pytest.mark.slow
def test_a_peer_that_reads_slowly_loses_nothing(drive, live, same, tmp_path):
    recording = drive(LEGS, tracks=("left", "right"))
    messages = live.messages_of(recording, step_s=10.0, provisional=True)
    found = []
    with served(tmp_path / "run") as (port, _, errors), socket.socket() as connection:
        connection.settimeout(WAIT_S)
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 16)
        connection.connect(("127.0.0.1", port))
        # It reads nothing before it has sent all.
        connection.sendall(live.as_lines(messages))
        with connection.makefile("rb") as stream:
            found = [json.loads(line) for line in stream]
    assert not errors
    same(live.profile_of(found), read_profile(tmp_path / "run"))
    numbers = [
        a["first"] + np.arange(len(a["tracks"]["left"]["valid"]))
        for a in found
        if a["kind"] == "points" and a["state"] == "provisional"
    ]
    assert (np.diff(np.concatenate(numbers)) == 1).all()


@pytest.mark.parametrize(
    ("host", "is_this"),
    [
        ("127.0.0.1", True),
        ("::1", True),
        ("127.3.4.5", True),
        ("localhost", True),
        ("0.0.0.0", False),
        ("::", False),
        ("192.168.1.4", False),
        ("localhost.example.org", False),
        ("", False),
    ],
)
def test_addresses_of_this_machine_are_known(host, is_this):
    assert is_loopback(host) == is_this


@pytest.mark.parametrize("content", [b"", b"short\n", b"\xff" * 20, b"x" * 1001])
def test_a_token_that_is_no_token_is_named(tmp_path, content):
    (tmp_path / "token").write_bytes(content)
    with pytest.raises(InputError, match=r"token: (the token has \d+ characters|is no text)"):
        read_token(tmp_path / "token")


def test_a_token_may_end_in_a_line_end(tmp_path):
    (tmp_path / "token").write_text(f"{TOKEN}\r\n", encoding="utf-8")
    assert read_token(tmp_path / "token") == TOKEN
