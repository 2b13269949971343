"""Where the sources of the C library are."""

from importlib.resources import files
from pathlib import Path


def c_sources() -> Path:
    """Return the folder of the C library: `floatref.h`, `src/` and `CMakeLists.txt`.

    Pass it to a compiler as `numpy.get_include()` is passed: ``-I`` this folder, and all of
    ``src/*.c``. It is the same in an editable and in an installed package.
    """
    return Path(str(files("floatref.c")))
