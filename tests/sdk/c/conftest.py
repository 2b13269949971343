"""The C library in double and in float, built once for a session, and its objects as Python's."""

import fcntl
import importlib
import importlib.util
import os
import re
import shutil
import subprocess
from functools import cache, reduce

import numpy as np
import pytest

import floatref
from floatref import kernels
from floatref.c import amalgamation
from floatref.kernels import compiling
from floatref.stages.filters import varying
from floatref.values.arrays import new_record

FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Wconversion", "-pedantic")
FLAGS += tuple(os.environ.get("FLOATREF_C_FLAGS", "").split())
COMPILER = os.environ.get("CC", "cc")
KERNELS = (
    "local_suppression",
    "matched_high_pass",
    "motion",
    "schedule",
    "state_variable",
    "varying",
    "varying_states",
)
NAMES = {"double": np.float64, "float": np.float32}


class Made:
    """An object of the library, in memory of its own."""

    def __init__(self, library, kind, memory):
        self.library, self.kind, self.memory = library, kind, memory

    @property
    def pointer(self):
        address = self.library.ffi.cast("void *", self.memory.ctypes.data)
        return self.library.ffi.cast(f"fr_{self.kind} *", address)

    def copy(self):
        """Return an object in a copy of the memory, at another address."""
        return Made(self.library, self.kind, self.memory.copy())

    def call(self, name, *arguments):
        return getattr(self.library.lib, f"fr_{self.kind}_{name}")(self.pointer, *arguments)

    def push(self, *signals, call="push", outputs=1, capacity=None):
        """Return the status and the outputs, cut to what was written; NaN where nothing was."""
        arrays = [self.library.array(x) for x in signals]
        count = len(arrays[0]) if arrays else 0
        capacity = count if capacity is None else capacity
        made = [np.full(capacity, np.nan, self.library.dtype) for _ in range(outputs)]
        written = self.library.ffi.new("size_t *", 12345)
        inputs = [self.library.at(x) for x in arrays]
        results = [self.library.at(y) for y in made]
        status = self.call(call, *inputs, count, *results, capacity, written)
        self.written = written[0]
        return status, *(y[: self.written] if status == 0 else y for y in made)


class Library:
    """The shared library of one precision."""

    def __init__(self, precision, program):
        cffi = pytest.importorskip("cffi")
        self.ffi, self.dtype = cffi.FFI(), NAMES[precision]
        text = (floatref.c_sources() / "floatref.h").read_text(encoding="utf-8")
        plain = re.sub(r"^#include .*$", "", text, flags=re.M)
        macro = ["-DFR_FLOAT"] if precision == "float" else []
        command = [COMPILER, "-E", "-P", "-DFR_API=", *macro, "-"]
        found = subprocess.run(command, input=plain, capture_output=True, text=True, check=True)
        self.ffi.cdef(found.stdout)
        self.lib = self.ffi.dlopen(str(program))
        listed = text[text.index("    FR_OK = 0") :].partition("};")[0]
        self.status = {int(n): name for name, n in re.findall(r"(FR_\w+) = (\d+)", listed)}

    def array(self, x):
        x = np.asarray(x)
        kind = np.int64 if x.dtype.kind in "iu" else self.dtype
        return np.ascontiguousarray(x, kind)

    def at(self, x):
        kind = "int64_t *" if x.dtype == np.int64 else "fr_real *"
        return self.ffi.cast(kind, x.ctypes.data)

    def config(self, kind, **settings):
        config = self.ffi.new(f"fr_{kind}_config *")
        config[0] = getattr(self.lib, f"fr_{kind}_defaults")()
        for name, value in settings.items():
            *inner, field = name.split("__")
            setattr(reduce(getattr, inner, config), field, value)
        return config

    def memory(self, kind, config):
        size = getattr(self.lib, f"fr_{kind}_size")(config)
        return np.zeros(size // 8 + 1, np.uint64)

    def make(self, kind, **settings):
        """Return an object of ``kind`` at its defaults, but for ``settings``."""
        config = self.config(kind, **settings)
        memory, out = self.memory(kind, config), self.ffi.new(f"fr_{kind} **")
        address = self.ffi.cast("void *", memory.ctypes.data)
        status = getattr(self.lib, f"fr_{kind}_init")(address, memory.nbytes, config, out)
        assert status == 0, self.text(status)
        return Made(self, kind, memory)

    def text(self, status):
        return self.ffi.string(self.lib.fr_status_text(status)).decode()

    def array_call(self, name, config, *signals, outputs=1):
        """Return the status and the outputs of a call that has no object."""
        arrays = [self.array(x) for x in signals]
        made = np.full(len(arrays[0]), np.nan, self.dtype)
        written = self.ffi.new("size_t *")
        inputs = [self.at(x) for x in arrays]
        call = getattr(self.lib, name)
        status = call(config, *inputs, made.size, self.at(made), made.size, written)
        return status, made


@pytest.fixture(scope="session")
def compiler():
    """Return the C compiler; without one the tests are left out, but not where CI runs them."""
    if shutil.which(COMPILER) is None:
        assert os.environ.get("CI") != "true", "the README asks for a C compiler"
        pytest.skip(f"no C compiler: {COMPILER} is not found")
    return COMPILER


def built(compiler, precision, shared):
    """Return the shared library of one precision in the folder ``shared``."""
    folder = shared / f"libfloatref-{precision}"
    folder.mkdir(exist_ok=True)
    program = folder / "libfloatref.so"
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not program.exists():
            assert amalgamation.main([str(folder)]) == 0
            macro = ["-DFR_FLOAT"] if precision == "float" else []
            command = [compiler, *FLAGS, *macro, "-fPIC", "-shared", "-o", program]
            source = [folder / "floatref.c", "-lm"]
            found = subprocess.run([*command, *source], capture_output=True, text=True)
            assert (found.returncode, found.stderr) == (0, ""), found.stderr
    return program


@pytest.fixture(scope="session")
def build(compiler, tmp_path_factory):
    """Return a function that builds the library in one precision, once."""
    made, own = {}, tmp_path_factory.getbasetemp()
    # The processes of one session have folders in one: the first that needs the library builds it.
    shared = own.parent if "PYTEST_XDIST_WORKER" in os.environ else own

    def library(precision):
        if precision not in made:
            made[precision] = Library(precision, built(compiler, precision, shared))
        return made[precision]

    return library


@pytest.fixture(scope="session")
def double(build):
    return build("double")


@pytest.fixture(scope="session")
def single(build):
    return build("float")


@pytest.fixture(scope="session")
def plain():
    """Return a function that loads a module of kernels as Python runs it, without numba.

    Its products and sums are not fused, as in a C library that is built so.
    """

    @cache
    def load(name):
        with pytest.MonkeyPatch.context() as patched:
            patched.setattr(compiling, "compiled", lambda function: function)
            spec = importlib.util.find_spec(f"floatref.{name}")
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
        return module

    return load


@pytest.fixture
def plain_sdk(plain, monkeypatch):
    """Let the stages of the SDK run their kernels without numba."""
    for name in KERNELS:
        importlib.import_module(f"floatref.kernels.{name}")
        monkeypatch.setattr(kernels, name, plain(f"kernels.{name}"))
    # Python reads fields of a record by name, but not those of an element of an array.
    monkeypatch.setattr(varying, "new_records", lambda n, of: [new_record(of) for _ in range(n)])
    return kernels
