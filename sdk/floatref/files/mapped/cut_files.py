"""A file that is cut short while it is mapped: an InputError in place of the end of the process.

Reading a page of a mapped file behind its end is the signal SIGBUS, which ends the process without
a line and leaves its temporary files. Python's own handlers run too late: the processor repeats
the read until it succeeds. So a handler of C, which ctypes makes of `_cover`, puts pages of zeros
in place of those that are gone, and sends a second signal, `SECOND`, which waits until it returns.
That one has a handler of Python: the read ends, and the thread gets the exception `CutFile` before
it calls another function of Python. So no result is made of the zeros.

SIGBUS comes in the middle of a read of memory, in code that copies or computes, and not in that
of the interpreter; so the handler may call whatever that code may call. A thread without the lock
of the interpreter waits for it. Python calls its handlers in the main thread alone: in any other
the process ends, with the same line. A SIGBUS that no file of ours explains ends it as before.
"""

import ctypes
import mmap
import os
import signal
import threading
import weakref
from dataclasses import dataclass
from pathlib import Path

from floatref.errors import InputError

MAP_FIXED = 0x10
"""Of mmap(2), on Linux and macOS."""
FAILED = ctypes.c_void_p(-1).value
SECOND = getattr(signal, "SIGRTMAX", 1) - 1
"""The signal by which the handler of C calls that of Python; only Linux has signals to spare."""


@dataclass(eq=False)
class _Watched:
    """A map of a file; from the byte ``sound`` on, zeros have replaced what is gone."""

    map: "weakref.ref[mmap.mmap]"
    address: int
    path: Path
    sound: int


class CutFile(InputError):
    """A file that became shorter while it was read; without a text, it is the last one found."""

    def __init__(self, text: str = "") -> None:
        """Take the text, or that of the file that was found cut last."""
        super().__init__(text or describe(_state.last))


def describe(path: Path | None) -> str:
    """Return the line on the file ``path``, which was cut."""
    return f"{path}: was cut short while it was read; wait until it is complete, and read it again"


class _State:
    """What the handler has to know: the maps, the functions of C, the file that was cut last."""

    def __init__(self) -> None:
        self.watched: list[_Watched] = []
        self.lock = threading.Lock()
        self.last: Path | None = None
        self.library: ctypes.CDLL | None = None
        self.handler: object = None


_state = _State()


def watch(mapped: mmap.mmap, address: int, path: Path) -> None:
    """Have a cut of the file ``path``, mapped at ``address``, raise CutFile where it is read.

    Does nothing but on Linux, and until the main thread has called it.
    """
    with _state.lock:
        _arm()
        alive = [one for one in _state.watched if one.map() is not None]
        new = _Watched(weakref.ref(mapped), address, path, len(mapped))
        # The handler may run at any time: it sees the old list or the new one.
        _state.watched = [*alive, new]


def _arm() -> None:
    """Install both handlers in the main thread, unless they are there or others are."""
    main = threading.current_thread() is threading.main_thread()
    if _state.library is not None or not main or not hasattr(signal, "SIGRTMAX"):
        return
    if any(signal.getsignal(n) is not signal.SIG_DFL for n in (signal.SIGBUS, SECOND)):
        return
    library = ctypes.CDLL(None)
    size, whole = ctypes.c_size_t, ctypes.c_int
    library.mmap.argtypes = (ctypes.c_void_p, size, whole, whole, whole, ctypes.c_long)
    library.mmap.restype = ctypes.c_void_p
    library.signal.argtypes = (whole, ctypes.c_void_p)
    library.signal.restype = ctypes.c_void_p
    handler = ctypes.CFUNCTYPE(None, whole)(_cover)
    signal.signal(SECOND, _raise)
    _state.library, _state.handler = library, handler
    library.signal(signal.SIGBUS, ctypes.cast(handler, ctypes.c_void_p))


def _cover(number: int) -> None:
    """Put zeros where a mapped file has lost pages, and have CutFile raised in this thread."""
    library = _state.library
    assert library is not None
    # Each of them: several may have been cut at once.
    lost = [_replace_lost(library, one) for one in _state.watched]
    if not any(lost):
        # Not ours: the read is repeated, and the system does what it does about it.
        library.signal(number, None)
        return
    if threading.get_ident() != threading.main_thread().ident:
        os.write(2, f"Error: {CutFile()}\n".encode())
        os._exit(2)
    # Blocked until this handler returns, which restores what was blocked before.
    signal.pthread_sigmask(signal.SIG_BLOCK, {SECOND})
    signal.pthread_kill(threading.get_ident(), SECOND)


def _raise(number: int, frame: object) -> None:
    """Raise CutFile, in the middle of what has read."""
    raise CutFile


def _replace_lost(library: ctypes.CDLL, one: _Watched) -> bool:
    """Replace the pages that the file of ``one`` has lost since; return whether it lost any."""
    mapped = one.map()
    if mapped is None or mapped.closed:
        return False
    first = -(-mapped.size() // mmap.PAGESIZE) * mmap.PAGESIZE
    if first >= one.sound:
        return False
    writable, flags = mmap.PROT_READ | mmap.PROT_WRITE, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS
    made = library.mmap(one.address + first, one.sound - first, writable, flags | MAP_FIXED, -1, 0)
    one.sound, _state.last = first, one.path
    return bool(made != FAILED)
