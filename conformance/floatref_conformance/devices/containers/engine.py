"""The command that runs containers, podman or docker, and the words that it is given."""

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from floatref.errors import InputError
from floatref.files.owners import NAME, is_abandoned
from floatref_conformance.devices.environment import environment_of
from floatref_conformance.devices.process import readable

PROGRAMS = ("podman", "docker")
"""Commands that run containers, the preferred one first: podman needs no service."""
VARIABLES = (
    "CONTAINER_HOST",
    "CONTAINERS_CONF",
    "CONTAINERS_STORAGE_CONF",
    "DBUS_SESSION_BUS_ADDRESS",
    "DOCKER_CERT_PATH",
    "DOCKER_CONFIG",
    "DOCKER_CONTEXT",
    "DOCKER_HOST",
    "DOCKER_TLS_VERIFY",
)
"""Variables by which the commands find their service; no container gets them."""
IMAGE = re.compile(r"[A-Za-z0-9][A-Za-z0-9._/:@+-]{0,254}")
"""What the name of an image may be; a command has to judge the rest."""
IDENTITY = re.compile(r"(sha256:)?(?P<digest>[0-9a-f]{64})")
MOST_PROCESSES = 512
"""Processes and threads of a container: what splits itself without end stops there."""
ANSWER_S = 60.0
"""Time in s for a command that starts nothing."""
RECORDINGS, PROFILES = "/floatref/recordings", "/floatref/profiles"
"""Folders in the container: what the device reads, and where it writes."""


@dataclass(frozen=True)
class Engine:
    """A command that runs containers; ``program`` is its path."""

    program: str

    @property
    def name(self) -> str:
        """The name of the command."""
        return Path(self.program).stem

    def find_image(self, image: str) -> str:
        """Return the SHA-256 that identifies ``image``; InputError if it is not on this machine."""
        ended = self._ask(("image", "inspect", "--format", "{{.Id}}", image))
        found = IDENTITY.fullmatch(ended.stdout.strip())
        if ended.returncode != 0 or found is None:
            why = readable(ended.stderr or ended.stdout or "no answer")
            raise InputError(
                f"{self.name} finds no such image ({why}); build it, or `{self.name} pull` it "
                "first: the judge loads nothing over a network"
            )
        return found["digest"]

    def remove_abandoned(self) -> None:
        """Remove containers of judges that were killed together with what ends containers."""
        words = ("ps", "--all", "--filter", "name=floatref-", "--format", "{{.Names}}")
        for name in self._ask(words).stdout.split():
            owner = NAME.match(name)
            if owner and is_abandoned(owner["mark"]):
                self._ask(("rm", "--force", name))

    def words_to_run(
        self, name: str, digest: str, folder: Path, variables: Sequence[str]
    ) -> tuple[str, ...]:
        """Return the command line that runs image ``digest`` as the container ``name``.

        It reads ``folder``/recordings, writes ``folder``/profiles, and gets ``variables`` of the
        environment of the command, whose values are not in the command line.
        """
        return (
            *(self.program, "run", "--interactive", "--rm", "--name", name),
            *("--pull", "never", "--network", "none", "--log-driver", "none"),
            *("--cap-drop", "ALL", "--security-opt", "no-new-privileges"),
            *("--pids-limit", str(MOST_PROCESSES)),
            *("--read-only", "--tmpfs", "/tmp"),
            *("--volume", f"{folder / 'recordings'}:{RECORDINGS}:ro,Z"),
            *("--volume", f"{folder / 'profiles'}:{PROFILES}:Z"),
            *self._user(),
            *(word for variable in variables for word in ("--env", variable)),
            digest,
        )

    def _user(self) -> tuple[str, ...]:
        """Return the options by which files of the container belong to the judge's user."""
        if not hasattr(os, "getuid"):
            return ()
        same = ("--user", f"{os.getuid()}:{os.getgid()}")
        return ("--userns", "keep-id", *same) if self.name == "podman" and os.getuid() else same

    def _ask(self, words: Sequence[str]) -> "subprocess.CompletedProcess[str]":
        try:
            return subprocess.run(
                [self.program, *words],
                stdin=subprocess.DEVNULL,
                capture_output=True,
                encoding="utf-8",
                errors="replace",
                env=environment_of(VARIABLES),
                timeout=ANSWER_S,
                check=False,
            )
        except subprocess.TimeoutExpired as error:
            raise InputError(
                f"{self.name} gave no answer within {ANSWER_S:g} s; start its service"
            ) from error
        except OSError as error:
            raise InputError(f"{self.name} cannot be started ({error.strerror})") from error


def find_engine(image: str) -> tuple[Engine, str]:
    """Return the first command that has ``image``, and its SHA-256.

    Raises InputError without a command, which says what to install, and if no command has it: an
    image that one of them built is not known to the other.
    """
    found = [shutil.which(name) for name in PROGRAMS]
    engines = [Engine(os.path.abspath(program)) for program in found if program is not None]
    refused = []
    for engine in engines:
        try:
            return engine, engine.find_image(image)
        except InputError as error:
            refused.append(str(error))
    raise InputError(
        "; ".join(refused)
        or "neither podman nor docker is found; install one of them, podman needs no root"
    )


def check_image(image: str) -> None:
    """Raise InputError unless ``image`` can be the name of an image, and not an option."""
    if not IMAGE.fullmatch(image):
        raise InputError(
            "no name of an image; give one as registry/name:tag, with letters, digits and ._/:@+- "
            "alone, the first a letter or a digit"
        )


def check_folder() -> None:
    """Raise InputError if the folder for temporary files cannot be given to a container."""
    folder = tempfile.gettempdir()
    if os.name == "posix" and ":" in folder:
        raise InputError(f"{folder} has a colon, which no container takes; set TMPDIR to another")
