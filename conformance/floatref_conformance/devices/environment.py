"""The variables of the environment that a device gets: those of a system, and those asked for.

The judge's environment may hold passwords of a build server, which a device under test has no
business with. So a device gets what programs need to be found, started and shown, and what
``--env NAME`` adds. It never gets the folder of the cache, where the truth is.
"""

import os
import re
from collections.abc import Iterable, Mapping

from floatref.errors import InputError
from floatref_conformance.proving_ground.cache import FOLDER_VARIABLE

ALLOWED = re.compile(
    "|".join(
        (
            "PATH|HOME|USER|LOGNAME|SHELL|TERM|PWD|LANG|LANGUAGE|LC_[A-Z]+|TZ|TMPDIR|TEMP|TMP",
            # Where libraries are, and how many threads they use.
            "LD_LIBRARY_PATH|DYLD_[A-Z_]+|VIRTUAL_ENV|CONDA_PREFIX|PYTHON[A-Z0-9]*",
            "(OMP|MKL|OPENBLAS|BLIS|NUMEXPR|NUMBA)_[A-Z0-9_]+|MCR_CACHE_ROOT|JAVA_HOME",
            "XDG_(CACHE|CONFIG|DATA|RUNTIME)_(HOME|DIR)|DISPLAY",
            # Without these Windows starts few programs.
            "SYSTEMROOT|SYSTEMDRIVE|WINDIR|COMSPEC|PATHEXT|OS|APPDATA|LOCALAPPDATA|USERPROFILE",
            "PROGRAMDATA|ALLUSERSPROFILE|(COMMON)?PROGRAM(FILES|W6432)(\\(X86\\))?",
            "NUMBER_OF_PROCESSORS|PROCESSOR_[A-Z]+",
        )
    ),
    re.IGNORECASE,
)
"""Names of the variables that every device gets."""


def environment_of(added: Iterable[str] = ()) -> dict[str, str]:
    """Return the environment of a device: what is `ALLOWED`, and the variables ``added``."""
    given = {name: os.environ[name] for name in added if name in os.environ}
    usual = {name: text for name, text in os.environ.items() if ALLOWED.fullmatch(name)}
    return {n: t for n, t in (usual | given).items() if n != FOLDER_VARIABLE}


def check_variables(added: Iterable[str], environ: Mapping[str, str] = os.environ) -> None:
    """Raise InputError for a variable of ``added`` that is not set, or that no device gets."""
    for name in added:
        if name == FOLDER_VARIABLE:
            raise InputError(f"--env {name}: no device gets the folder of the truth; leave it out")
        if name not in environ:
            raise InputError(f"--env {name}: is not set; set it, or leave it out")
