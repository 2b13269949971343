"""A port at which peers connect, one at a time, until the run is complete."""

import socket
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from ipaddress import ip_address
from pathlib import Path

from floatref.errors import InputError
from floatref.files.sources import open_bytes
from floatref.live.session.live_run import LiveRun
from floatref.live.session.serving import Peer, Serving

PAUSE_S = 0.2
"""Time in s between two looks for Ctrl-C while nobody connects."""
PARTING_S = 2.0
"""Longest time in s that a peer has to close its end."""
KEEPALIVE = {"TCP_KEEPIDLE": 30, "TCP_KEEPINTVL": 10, "TCP_KEEPCNT": 3}
"""A host that vanishes is noticed after a minute; seconds, seconds and a count."""
SHORTEST_TOKEN, LONGEST_TOKEN = 16, 1000
Say = Callable[[str], None]


def is_loopback(host: str) -> bool:
    """Return whether ``host`` is this machine alone; of names, only "localhost" is."""
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def read_token(path: Path) -> str:
    """Return the token in the file ``path``; InputError for one that is short or no text."""
    with open_bytes(path) as stream:
        content = stream.read(4 * LONGEST_TOKEN + 2)
    try:
        token = content.decode().strip()
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: is no text; write the token into it") from error
    if not SHORTEST_TOKEN <= len(token) <= LONGEST_TOKEN:
        raise InputError(
            f"{path}: the token has {len(token)} characters; write {SHORTEST_TOKEN} to "
            f"{LONGEST_TOKEN} random ones into it"
        )
    return token


def serve_connections(
    run: LiveRun, host: str, port: int, token: str, announce: Say, say: Say
) -> None:
    """Serve ``run`` to one peer after another until it is complete.

    ``announce`` is called with the line that names host and port once peers can connect, and
    ``say`` with why a peer has gone, or was not let in: that does not end the run. Raises
    InputError if the port cannot be opened, and for a message that cannot be used.
    """
    with _open(host, port) as server:
        server.settimeout(PAUSE_S)
        where, number = server.getsockname()[:2]
        announce(f"Listening on {where}:{number}")
        while not run.complete:
            with _accept(server, token) as peer:
                _serve(run, peer, say)


def _open(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        return socket.create_server((host, port), family=family, backlog=1)
    except (OSError, OverflowError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            f"{host}:{port}: cannot be listened at ({reason}); choose another port or --host"
        ) from error


@contextmanager
def _accept(server: socket.socket, token: str) -> Iterator[Peer]:
    connection, address = _wait(server)
    with connection, connection.makefile("rb") as stream:
        connection.settimeout(None)
        _keep_alive(connection)
        try:
            yield Peer(
                stream, connection.sendall, f"{address[0]}:{address[1]}", token, is_remote=True
            )
        finally:
            with suppress(OSError):
                _part(connection)


def _part(connection: socket.socket) -> None:
    """End the connection so that the peer can read the last answers.

    Samples that nobody has read would make the system throw away what the peer has not read yet.
    """
    connection.shutdown(socket.SHUT_WR)
    connection.settimeout(PAUSE_S)
    until_s = time.monotonic() + PARTING_S
    while time.monotonic() < until_s:
        with suppress(TimeoutError):
            if not connection.recv(1 << 16):
                break
    # Wakes the thread that still reads, which otherwise holds the lock of the stream.
    connection.shutdown(socket.SHUT_RDWR)


def _wait(server: socket.socket) -> tuple[socket.socket, tuple[str, int]]:
    while True:
        with suppress(TimeoutError):
            return server.accept()


def _keep_alive(connection: socket.socket) -> None:
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
    for name, value in KEEPALIVE.items():
        if hasattr(socket, name):
            connection.setsockopt(socket.IPPROTO_TCP, getattr(socket, name), value)


def _serve(run: LiveRun, peer: Peer, say: Say) -> None:
    serving = Serving(run, peer)
    try:
        serving.serve()
    except InputError as error:
        if serving.greeted and not serving.is_lost:
            raise
        say(f"{peer.name}: {error}" if not str(error).startswith(peer.name) else str(error))
