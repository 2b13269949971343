"""Check the C library by clang-tidy and by cppcheck with its MISRA rules, where they are installed.

python .ci/check_c.py

A tool that is missing is skipped in one line. MISRA rules that the code departs from have to be
those of the table in docs/c-library.md: one that is not there fails, and so does one too many.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
LIBRARY = ROOT / "sdk" / "floatref" / "c"
PAGE = ROOT / "docs" / "c-library.md"
TIDY = "-*,bugprone-*,cert-*,clang-analyzer-*,-bugprone-easily-swappable-parameters"
SUPPRESSED = ("knownConditionTrueFalse", "missingIncludeSystem")
"""The first is wrong about the length of a block: it takes `count - done` for 0."""
FINDING = re.compile(r": (style|error|warning|performance|portability): ")
RULE = re.compile(r"\[misra-c2012-([\d.]+)\]")


def deviations() -> set[str]:
    """Return the rules that the page lists as deviations."""
    return set(re.findall(r"^\| (\d+\.\d+) \|", PAGE.read_text(encoding="utf-8"), re.M))


def tidy(program: str) -> list[str]:
    """Return the warnings of clang-tidy."""
    files = sorted(map(str, (LIBRARY / "src").glob("*.c")))
    command = [program, "--quiet", f"-checks={TIDY}", *files, "--", "-std=c99", f"-I{LIBRARY}"]
    found = subprocess.run(command, capture_output=True, text=True)
    lines = [line for line in found.stdout.splitlines() if re.search(r": (warning|error): ", line)]
    return lines or failure(program, found)


def failure(program: str, done: subprocess.CompletedProcess[str]) -> list[str]:
    """Return a line if the program has failed: one that says nothing has found nothing."""
    last = (done.stderr or done.stdout).strip().splitlines()[-1:]
    return [f"{program}: exit code {done.returncode} {' '.join(last)}"] if done.returncode else []


def misra(program: str) -> list[str]:
    """Return what cppcheck finds beside the deviations, and deviations that it does not find."""
    options = ["--addon=misra", "--std=c99", "--enable=style,performance,portability", "--quiet"]
    options += [f"--suppress={name}" for name in SUPPRESSED]
    # Else it writes its files beside the sources.
    with tempfile.TemporaryDirectory() as folder:
        options.append(f"--cppcheck-build-dir={folder}")
        command = [program, *options, f"-I{LIBRARY}", str(LIBRARY / "src")]
        done = subprocess.run(command, capture_output=True, text=True)
    lines = [line for line in done.stderr.splitlines() if FINDING.search(line)]
    matches = {line: RULE.search(line) for line in lines}
    rules = {match[1] for match in matches.values() if match}
    allowed = deviations()
    wrong = [line for line, match in matches.items() if not match or match[1] not in allowed]
    wrong = wrong or failure(program, done)
    return wrong + [f"rule {rule}: no longer departed from" for rule in sorted(allowed - rules)]


def main() -> int:
    """Return 1 if a tool that is installed finds something."""
    code = 0
    for name, check in (("clang-tidy", tidy), ("cppcheck", misra)):
        program = shutil.which(name)
        if program is None:
            print(f"{name}: skipped, it is not installed")
            continue
        found = check(program)
        print("\n".join(found) if found else f"{name}: clean")
        code |= bool(found)
    return code


if __name__ == "__main__":
    sys.exit(main())
