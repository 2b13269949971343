"""Run the `console` blocks of a page and compare, or replace, what they show.

    python .ci/consoles.py [--write] docs/tutorial.md

All blocks of a page run in order in one temporary folder. A line that starts with `$ ` is a
command (bash), the lines up to the next one are its standard output. Numbers may differ by two
per cent, or by 0.02; everything else has to be equal. `--write` puts the output into the page,
and pictures of the names that the page shows into its folder `images`. Python blocks that open
with a comment `# file: NAME` are written to that file.
"""

import argparse
import math
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

BLOCK = re.compile(r"^```(console|python)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"# file: (\S+)\n")
PICTURE = re.compile(r"\]\(images/(\S+\.png)\)")
NUMBER = re.compile(r"[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
RULE = re.compile("─+")
RELATIVE, ABSOLUTE = 0.02, 0.02


class Shell:
    """Runs commands one by one in ``folder`` and remembers the last exit code."""

    def __init__(self, folder: Path) -> None:
        """Put this Python's scripts first on the path, and simulations into ``folder``."""
        self.folder, self.code = folder, 0
        path = os.pathsep.join([sysconfig.get_path("scripts"), os.environ.get("PATH", "")])
        cache = str(folder / ".cache")
        self.environment = {**os.environ, "PATH": path, "FLOATREF_CACHE": cache}

    def run(self, command: str) -> str:
        """Return the standard output of ``command``, without spaces at the ends of lines."""
        if command == "echo $?":
            return f"{self.code}\n"
        done = subprocess.run(
            ["bash", "-c", command],
            cwd=self.folder,
            env=self.environment,
            stdout=subprocess.PIPE,
            text=True,
            encoding="utf-8",
        )
        self.code = done.returncode
        lines = "\n".join(line.rstrip() for line in done.stdout.splitlines()).strip("\n")
        return f"{lines}\n" if lines else ""


def performed(text: str, shell: Shell) -> str:
    """Return ``text`` with the output of every command in place of what is shown."""

    def replaced(block: re.Match[str]) -> str:
        kind, body = block.groups()
        if kind == "python":
            named = FILE.match(body)
            if named:
                (shell.folder / named[1]).write_text(body, encoding="utf-8")
            return block[0]
        commands = [line[2:] for line in body.splitlines() if line.startswith("$ ")]
        shown = "".join(f"$ {command}\n{shell.run(command)}" for command in commands)
        return f"```console\n{shown}```"

    return BLOCK.sub(replaced, text)


def differences(expected: str, found: str) -> list[str]:
    """Return the lines of ``found`` that are not those of ``expected``, numbers aside."""
    pairs = zip(expected.splitlines(), found.splitlines(), strict=False)
    lines = [f"- {e}\n+ {f}" for e, f in pairs if not _alike(e, f)]
    if len(expected.splitlines()) != len(found.splitlines()):
        lines.append("the numbers of lines differ")
    return lines


def _alike(expected: str, found: str) -> bool:
    # Tables are padded and ruled to their longest number, so spaces and rules do not count.
    shown, printed = (RULE.sub("─", NUMBER.sub("#", line)).split() for line in (expected, found))
    if shown != printed:
        return False
    pairs = zip(NUMBER.findall(expected), NUMBER.findall(found), strict=True)
    return all(
        math.isclose(_value(e), _value(f), rel_tol=RELATIVE, abs_tol=ABSOLUTE) for e, f in pairs
    )


def _value(text: str) -> float:
    return float(text.replace("−", "-"))


def main() -> int:
    """Run a page; return 1 if it shows something else than what its commands print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="replace what the page shows")
    parser.add_argument("page", type=Path)
    options = parser.parse_args()
    text = options.page.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as name:
        found = performed(text, Shell(Path(name)))
        if not options.write:
            wrong = differences(text, found)
            print("\n".join(wrong))
            return 1 if wrong else 0
        options.page.write_text(found, encoding="utf-8")
        for picture in PICTURE.findall(text):
            # Some pictures are taken by a browser: .ci/view_pictures.py.
            if Path(name, picture).is_file():
                shutil.copy(Path(name, picture), options.page.parent / "images" / picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
