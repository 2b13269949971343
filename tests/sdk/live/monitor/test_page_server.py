"""The page is for browsers on this machine: one address, GET alone, no network."""

import base64
import hashlib
import http.client
import json
import re
import socket
from dataclasses import replace
from threading import Event, Thread, Timer

import numpy as np
import pytest

from floatref import InputError
from floatref.live.monitor import page_server as page_server_module
from floatref.live.monitor.page_server import CONNECTIONS, page_server, read_page
from floatref.live.monitor.run_monitor import RunMonitor

WAIT_S = 60.0


@pytest.fixture
def served(monkeypatch):
    # These tests look at a page and end it at once.
    monkeypatch.setattr(page_server_module, "PARTING_S", 0.0)
    monitor = RunMonitor("run")
    with page_server(monitor.shown, 0) as address:
        yield int(address.rstrip("/").rpartition(":")[2]), monitor


def ask(port, path="/", method="GET", host=None, body=None):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=WAIT_S)
    headers = {} if host is None else {"Host": host.replace("PORT", str(port))}
    connection.request(method, path, body, headers)
    answer = connection.getresponse()
    content = answer.read()
    connection.close()
    return answer, content


def test_the_page_is_whole_and_its_policy_allows_no_other_address(served):
    port, _ = served
    answer, content = ask(port)
    assert (answer.status, answer.headers["Content-Type"]) == (200, "text/html; charset=utf-8")
    text, policy = content.decode(), answer.headers["Content-Security-Policy"]
    assert not re.search(r"https?:|//[a-z]|@import|url\(", text.replace("\n  //", ""))
    for kind, tag in (("style-src", "style"), ("script-src", "script")):
        (inside,) = re.findall(rf"<{tag}>(.*?)</{tag}>", text, re.DOTALL)
        digest = base64.b64encode(hashlib.sha256(inside.encode()).digest()).decode()
        assert f"{kind} 'sha256-{digest}'" in policy
    assert policy.startswith("default-src 'none'; connect-src 'self';")
    assert "unsafe" not in policy
    assert answer.headers["X-Content-Type-Options"] == "nosniff"
    assert "Access-Control-Allow-Origin" not in answer.headers


def test_the_state_is_what_the_monitor_shows(served):
    port, monitor = served
    monitor.event("a line with </script> & <b>")
    answer, content = ask(port, "/state.json")
    assert answer.headers["Cache-Control"] == "no-store"
    found = json.loads(content)
    expected = monitor.shown().document() | {"for_s": found["for_s"]}
    assert {k: found[k] for k in expected} == json.loads(json.dumps(expected))
    assert found["events"][0]["text"] == "a line with </script> & <b>"


@pytest.mark.parametrize(
    "host", ["evil.example:PORT", "127.0.0.1", "127.0.0.1:1", "localhost.evil.example:PORT", ""]
)
@pytest.mark.parametrize("path", ["/", "/state.json"])
def test_another_host_is_refused(served, host, path):
    port, monitor = served
    monitor.event("secret")
    answer, content = ask(port, path, host=host)
    assert answer.status == 421
    assert b"secret" not in content
    assert b"<html" not in content


@pytest.mark.posix
def test_the_port_of_the_page_is_open_at_one_address_alone(served):
    with pytest.raises(OSError, match=r"refused|timed out|assign"):
        socket.create_connection(("127.0.0.2", served[0]), timeout=5.0)


def test_localhost_is_this_machine(served):
    assert ask(served[0], host="localhost:PORT")[0].status == 200


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS", "HEAD", "TRACE", "XYZ"])
def test_only_get_is_answered(served, method):
    answer, _ = ask(served[0], "/state.json", method)
    assert (answer.status, answer.headers["Allow"]) == (405, "GET")


@pytest.mark.parametrize("path", ["/../pyproject.toml", "/etc/passwd", "/%2e%2e/"])
def test_no_other_path_is_there(served, path):
    assert ask(served[0], path)[0].status == 404


def test_what_is_no_http_ends_nothing(served, capfd):
    port, _ = served
    for data in (b"\x16\x03\x01\x00\xa5\n\n", b"GET\n\n", b"GET / HTTP/9.9\r\n\r\n", b"x" * 70_000):
        with socket.create_connection(("127.0.0.1", port), WAIT_S) as peer:
            peer.sendall(data + b"\r\n\r\n")
            peer.shutdown(socket.SHUT_WR)
            try:
                while peer.recv(1 << 16):
                    pass
            except ConnectionResetError:
                pass
    assert ask(port)[0].status == 200
    assert capfd.readouterr() == ("", "")


def test_browsers_that_send_nothing_keep_nobody_out(served):
    port, _ = served
    idle = [socket.create_connection(("127.0.0.1", port), WAIT_S) for _ in range(CONNECTIONS - 2)]
    assert ask(port, "/state.json")[0].status == 200
    for each in idle:
        each.close()


@pytest.mark.slow
def test_a_flood_of_connections_is_closed_and_then_the_page_answers(served):
    port, _ = served
    idle = [socket.create_connection(("127.0.0.1", port), WAIT_S) for _ in range(3 * CONNECTIONS)]
    for each in idle:
        each.close()
    for _ in range(200):
        try:
            assert ask(port)[0].status == 200
            return
        except (ConnectionError, http.client.HTTPException):
            Event().wait(0.05)
    pytest.fail("no answer after the flood")


def test_an_open_page_gets_the_last_state(monkeypatch):
    monkeypatch.setattr(page_server_module, "PARTING_S", WAIT_S)
    monitor, last = RunMonitor("run"), []
    with page_server(monitor.shown, 0) as address:
        port = int(address.rstrip("/").rpartition(":")[2])
        ask(port, "/state.json")

        def poll():
            while not last or not json.loads(last[-1])["closing"]:
                last.append(ask(port, "/state.json")[1])

        page = Thread(target=poll, daemon=True)
        page.start()
        monitor.completed()
    page.join(WAIT_S)
    assert json.loads(last[-1])["status"] == "complete"
    with pytest.raises(OSError, match=r"refused|reset"):
        ask(port)


def test_a_state_from_before_the_end_is_not_taken_for_the_last(monkeypatch):
    monkeypatch.setattr(page_server_module, "PARTING_S", WAIT_S)
    monitor, given = RunMonitor("run"), []
    handler = page_server_module._Handler
    answer = handler._answer

    def answer_late(self, status, body, *more):
        answer(self, status, body, *more)
        given.append(json.loads(body)["closing"])
        # The run ends while this answer, made before, is on its way.
        self.server.source.closing = True

    monkeypatch.setattr(handler, "_answer", answer_late)
    with page_server(monitor.shown, 0) as address:
        port = int(address.rstrip("/").rpartition(":")[2])
        ask(port, "/state.json")
        later = Timer(0.3, ask, (port, "/state.json"))
        later.start()
    later.join(WAIT_S)
    assert given == [False, True]


def test_a_port_that_is_taken_is_one_line(served):
    with (
        pytest.raises(InputError, match=rf"^--web {served[0]}: 127.0.0.1:{served[0]} cannot"),
        page_server(RunMonitor("run").shown, served[0]),
    ):
        pass


def test_a_value_that_json_cannot_hold_is_null():
    shown = replace(RunMonitor("run").shown(), distance_m=np.inf, speed_mps=np.nan)
    document = shown.document()
    assert (document["distance_m"], document["speed_mps"]) == (None, None)


def test_the_page_has_no_markup_from_other_programs():
    page, _ = read_page()
    assert not re.search(rb"innerHTML|insertAdjacentHTML|document\.write|eval\(|\son\w+=", page)
