"""The site, built once for all tests of a session that look at it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CONFIG = ROOT / ".mkdocs.yml"
PAGES_ALONE = """
import sys
from mkdocs.commands.build import build
from mkdocs.config import load_config
config = load_config(sys.argv[1], site_dir=sys.argv[2], strict=False, plugins=["search", "offline"])
config.plugins.on_startup(command="build", dirty=False)
build(config)
"""
"""The API, which takes most of the time, is left out."""
WHOLE = """
import sys
from mkdocs.__main__ import cli
cli(["build", "--strict", "--quiet", "-f", sys.argv[1], "-d", sys.argv[2]])
"""


@pytest.fixture(
    scope="session",
    params=[PAGES_ALONE, pytest.param(WHOLE, marks=pytest.mark.slow)],
    ids=["pages", "whole"],
)
def site(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a site that was built, without and with its API."""
    folder: Path = tmp_path_factory.mktemp("site")
    subprocess.run(
        [sys.executable, "-c", request.param, str(CONFIG), str(folder)],
        env=os.environ | {"NO_MKDOCS_2_WARNING": "1"},
        cwd=ROOT,
        check=True,
    )
    return folder
