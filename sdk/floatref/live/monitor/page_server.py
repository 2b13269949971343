"""The page of an operator, served to browsers on this machine alone.

Its address is a number of this machine, so that a name which another host controls cannot lead a
browser here and read the answers: a request whose Host is another one is refused.
"""

import base64
import hashlib
import json
import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from socketserver import TCPServer
from threading import BoundedSemaphore, Lock, Thread
from typing import Any

from floatref.errors import InputError
from floatref.live.monitor.shown_state import Shown
from floatref.version import __version__

HERE = "127.0.0.1"
CONNECTIONS = 16
"""Most requests that are answered at once; others are closed."""
TIMEOUT_S = 5.0
"""Time in s that a browser has to send its request and to take the answer."""
OLDEST_S = 0.4
"""Age in s up to which a state is sent again, so that many pages cost no more than one."""
POLL_S = 0.1
"""Time in s between two looks for the end."""
LOOKED_S, PARTING_S = 3.0, 3.0
"""If a page has asked within the first time, in s, the end waits up to the second until it has the
last state."""
ALWAYS = {
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
}


def read_page() -> tuple[bytes, str]:
    """Return the page, with styles and script inside, and its Content-Security-Policy."""
    style, script = (_resource(name) for name in ("operator.css", "operator.js"))
    page = _resource("operator.html").replace("STYLE", style).replace("SCRIPT", script)
    policy = (
        "default-src 'none'; connect-src 'self'; img-src data:; "
        f"style-src {_hash(style)}; script-src {_hash(script)}; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )
    return page.encode(), policy


def _resource(name: str) -> str:
    return files("floatref.live.monitor").joinpath("page", name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


class _Source:
    """Makes the JSON of the state, at most once in `OLDEST_S`, whoever asks."""

    def __init__(self, shown: Callable[[], Shown]) -> None:
        self._shown, self._lock = shown, Lock()
        self._data, self._is_last, self._made_s = b"", False, -OLDEST_S
        self.asked_s: float | None = None
        self.closing = self.gave_last = False

    def data(self) -> tuple[bytes, bool]:
        """Return the state, and whether it says that it is the last."""
        with self._lock:
            now_s = time.monotonic()
            self.asked_s = now_s
            if self.closing or now_s - self._made_s >= OLDEST_S:
                shown = self._shown()
                document = {"format": "floatref-operator/1", "floatref": __version__}
                self._is_last = self.closing
                document |= shown.document() | {"closing": self._is_last}
                self._data = json.dumps(document, allow_nan=False).encode()
                self._made_s = time.monotonic()
            return self._data, self._is_last


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    request_queue_size = 4 * CONNECTIONS
    # On Windows it would take a port that another program has.
    allow_reuse_address = os.name == "posix"

    def __init__(self, port: int, source: _Source) -> None:
        self.source = source
        self.page, self.policy = read_page()
        self._free = BoundedSemaphore(CONNECTIONS)
        super().__init__((HERE, port), _Handler)

    def server_bind(self) -> None:
        """Open the port, without the search for a name of this machine in the network."""
        TCPServer.server_bind(self)

    def process_request(self, request: Any, client_address: Any) -> None:
        if self._free.acquire(blocking=False):
            super().process_request(request, client_address)
        else:
            self.shutdown_request(request)

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._free.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Leave standard error alone: a browser that has gone is no error of the run."""


class _Handler(BaseHTTPRequestHandler):
    server: _Server
    server_version = "floatref"
    sys_version = ""
    timeout = TIMEOUT_S

    def do_GET(self) -> None:
        port = self.server.server_address[1]
        if self.headers.get("Host") not in (f"{HERE}:{port}", f"localhost:{port}"):
            self._answer(HTTPStatus.MISDIRECTED_REQUEST, b"open the address that was printed\n")
        elif self.path == "/":
            policy = {"Content-Security-Policy": self.server.policy}
            self._answer(HTTPStatus.OK, self.server.page, "text/html; charset=utf-8", policy)
        elif self.path == "/state.json":
            data, is_last = self.server.source.data()
            self._answer(HTTPStatus.OK, data, "application/json")
            # A run that ends meanwhile has not been seen to end.
            self.server.source.gave_last |= is_last
        else:
            self._answer(HTTPStatus.NOT_FOUND, b"there is / and /state.json\n")

    def _answer(
        self,
        status: HTTPStatus,
        body: bytes,
        kind: str = "text/plain; charset=utf-8",
        more: Mapping[str, str] | None = None,
    ) -> None:
        self.send_response(status)
        about = {"Content-Type": kind, "Content-Length": str(len(body))}
        for name, value in {**about, **ALWAYS, **(more or {})}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def send_error(self, code: int, *_: Any, **__: Any) -> None:
        """Answer a request that is no GET, or no HTTP."""
        # The base class answers 501 to a method that it has no function for.
        wrong = code == HTTPStatus.NOT_IMPLEMENTED
        status = HTTPStatus.METHOD_NOT_ALLOWED if wrong else HTTPStatus(code)
        self._answer(status, f"{status.phrase}\n".encode(), more={"Allow": "GET"} if wrong else {})

    def log_message(self, *_: Any) -> None:
        """Write no line for each request."""


@contextmanager
def page_server(shown: Callable[[], Shown], port: int) -> Iterator[str]:
    """Serve the page of what ``shown`` returns until the end of the statement; yield its address.

    ``port`` 0 takes a free one. A page that is open gets the last state before the end. Raises
    InputError if the port cannot be opened.
    """
    source = _Source(shown)
    try:
        server = _Server(port, source)
    except (OSError, OverflowError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            f"--web {port}: {HERE}:{port} cannot be listened at ({reason}); choose another port"
        ) from error
    thread = Thread(target=server.serve_forever, args=(POLL_S,), name="floatref-web", daemon=True)
    thread.start()
    try:
        yield f"http://{HERE}:{server.server_address[1]}/"
    finally:
        _part(source)
        server.shutdown()
        server.server_close()


def _part(source: _Source) -> None:
    """Wait until an open page has the last state."""
    now_s = time.monotonic()
    looked = source.asked_s is not None and now_s - source.asked_s < LOOKED_S
    source.closing = True
    while looked and not source.gave_last and time.monotonic() < now_s + PARTING_S:
        with suppress(InterruptedError):
            time.sleep(0.05)
