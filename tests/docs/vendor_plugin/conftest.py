"""A fresh virtual environment that sees this one's packages, and what is installed into it."""

import os
import subprocess
import sysconfig
import venv
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from floatref import Channel, Recording, UniformClock

PLUGIN = Path(__file__).parents[3] / "docs" / "examples" / "vendor_plugin"
COMMAND = """#!{python}
import sys
from {package}.cli.main import main
sys.exit(main(prog_name="{name}"))
"""


class Environment:
    """A virtual environment in ``folder``; what is installed here is seen there, not the reverse.

    It needs no network: pip and what builds a distribution are those of this environment.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        venv.create(folder / "venv", symlinks=os.name != "nt")
        self.scripts = next(p for p in (folder / "venv").iterdir() if p.name in ("bin", "Scripts"))
        self.python = self.scripts / "python"
        outer = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
        lines = [f"import site; site.addsitedir({path!r})\n" for path in sorted(outer)]
        own = self.run("python", "-c", "import sysconfig; print(sysconfig.get_path('purelib'))")
        (Path(own.stdout.strip()) / "outer.pth").write_text("".join(lines))
        for name, package in (("floatref", "floatref"), ("conformance", "floatref_conformance")):
            script = COMMAND.format(python=self.python, package=package, name=name)
            (self.scripts / name).write_text(script)
            (self.scripts / name).chmod(0o755)

    def run(self, name: str, *words: object, code: int = 0) -> subprocess.CompletedProcess[str]:
        """Run a script of the environment and hold it to its exit code."""
        command = [str(self.scripts / name), *map(str, words)]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
        assert done.returncode == code, f"{command}\n{done.stdout}\n{done.stderr}"
        return done

    def install(self, *projects: Path) -> None:
        """Install the distributions whose sources are in ``projects``."""
        # Without hatchling here, pip gets it from the index.
        here = [] if find_spec("hatchling") is None else ["--no-build-isolation"]
        self.pip("install", "--quiet", "--no-deps", *here, *projects)

    def pip(self, *words: object) -> None:
        self.run("python", "-m", "pip", "--disable-pip-version-check", *words)


@pytest.fixture(scope="module")
def make_environment(
    tmp_path_factory: pytest.TempPathFactory,
) -> Callable[[], Environment]:
    return lambda: Environment(tmp_path_factory.mktemp("fresh"))


@pytest.fixture(scope="module")
def plugin() -> Path:
    return PLUGIN


@pytest.fixture(scope="module")
def installed(make_environment: Callable[[], Environment], plugin: Path) -> Environment:
    fresh = make_environment()
    fresh.install(plugin)
    return fresh


@pytest.fixture(scope="session")
def wavy() -> Recording:
    """16 s at 20 m/s over waves of 15 m, 10 mm high; the body does not follow, but for noise."""
    times, clock = np.arange(64_000) / 4000, UniformClock.of(4000)
    noise = np.random.default_rng(7).normal(0.0, 0.01, times.size)
    samples = {
        "vertical_specific_force": 9.80665 + noise,
        "height": 0.3 - 0.005 * np.sin(2 * np.pi * 20.0 * times / 15.0),
        "distance": 20.0 * times,
    }
    return Recording(tuple(Channel.of(name, x, clock) for name, x in samples.items()))
