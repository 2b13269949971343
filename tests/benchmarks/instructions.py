"""Count the instructions per sample of stages, which no other work on the machine changes.

Stages of the C library, built by ``cc -O2`` as docs/embedded.md builds them, and whole pipelines on
one wheel path at 16 kHz run under valgrind's callgrind at two lengths. The difference of the counts
by that of the samples is the cost of a sample, without start-up. Kernels are compiled for the
processor PROCESSOR whatever the machine has, so that counts of two machines can be compared.
Instructions are no time: loads that wait, divisions and branches cost more than others. Run as

    python tests/benchmarks/instructions.py [--pipeline NAME ...] [STAGE ...]
"""

import argparse
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from pathlib import Path

ROOT = Path(__file__).parents[2]
LIBRARY = ROOT / "sdk" / "floatref" / "c"
EMBEDDED = ROOT / ".ci" / "embedded"
COUNTED = Path(__file__).with_name("counted")
OF_SAMPLES = tuple(EMBEDDED / f"stages_of_{part}.c" for part in ("samples", "sets", "sensors"))
"""Stages in pieces: a call with a whole profile has one length alone."""
TOOLS = "cc", "valgrind"
HEADER = "#include <valgrind/callgrind.h>\n"
FLAGS = "-std=gnu99", "-O2", "-ffp-contract=off"
RATE_HZ = 16_000
PROCESSOR = "haswell"
"""As LLVM names it; valgrind 3.19 knows all its instructions, and not those of AVX-512."""
PIPELINES = ("temporal-adaptive-hpf-spatial-backward", "road-prior-smoother")
PART = re.compile(
    r"^desc: Trigger: Client Request: (\S+) rate (\d+) .*?samples (\d+).*?^totals: (\d+)$",
    re.DOTALL | re.MULTILINE,
)


def missing_tools() -> list[str]:
    """Return what is not installed, valgrind's header among it."""
    missing = [tool for tool in TOOLS if shutil.which(tool) is None]
    if missing:
        return missing
    command = ["cc", "-E", "-xc", "-"]
    found = subprocess.run(command, input=HEADER, capture_output=True, text=True)
    return ["valgrind/callgrind.h"] if found.returncode else []


def tools() -> dict[str, str]:
    """Return what the counts of C depend on beside the code."""
    return {
        "machine": platform.machine(),
        "cc": printed(["cc", "--version"]).splitlines()[0],
        "libc": " ".join(platform.libc_ver()),
    }


def python_tools() -> dict[str, str]:
    """Return what the counts of pipelines depend on beside the code."""
    names = ("numba", "llvmlite", "numpy")
    return {
        "machine": platform.machine(),
        "python": f"Python {platform.python_version()}",
        **{name: f"{name} {version(name)}" for name in names},
    }


def stages() -> list[str]:
    """Return the names of the stages of the C library."""
    sources = *OF_SAMPLES, COUNTED / "counted_stages.c"
    text = "".join(source.read_text(encoding="utf-8") for source in sources)
    return re.findall(r"^void stage_(\w+)\(void\)$", text, re.MULTILINE)


def of_stages(
    names: Sequence[str], library: Path = LIBRARY, longest_s: float | None = None
) -> dict[str, float]:
    """Return instructions per sample, or per point, of stages of the C library.

    TimeoutExpired comes after ``longest_s`` by the clock.
    """
    end = None if longest_s is None else time.monotonic() + longest_s
    with tempfile.TemporaryDirectory(prefix="floatref-counted-") as name:
        folder = Path(name)
        program = build(folder, library, end)
        found = callgrind(folder, ["--collect-atstart=no"], [program, *names], end=end)
        return {name: per_sample(found[name]) for name in names}


def build(folder: Path, library: Path, end: float | None = None) -> str:
    """Build the program that has all stages, a file on each processor at a time."""
    includes = [f"-I{each}" for each in (library, EMBEDDED, COUNTED)]
    compiler = ["cc", *FLAGS, *includes, "-include", str(COUNTED / "counting.h")]
    own = [COUNTED / "counting.c", COUNTED / "counted_stages.c"]
    own += [EMBEDDED / "signals.c", EMBEDDED / "pieces.c", *OF_SAMPLES]
    sources = [*own, *sorted((library / "src").glob("*.c"))]
    objects = [str(folder / f"{source.stem}.o") for source in sources]

    def compile_one(source: Path, made: str) -> None:
        printed([*compiler, "-c", str(source), "-o", made], end=end)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(compile_one, sources, objects))
    program = str(folder / "counted")
    printed(["cc", "-rdynamic", *objects, "-o", program, "-lm", "-ldl"], end=end)
    return program


def of_pipelines(names: Sequence[str], cache: Path | None = None) -> dict[str, float]:
    """Return instructions per sample of pipelines; compiled kernels are kept in ``cache``."""
    with tempfile.TemporaryDirectory(prefix="floatref-counted-") as name:
        folder = Path(name)
        marks, source = folder / "marks.so", COUNTED / "marks.c"
        printed(["cc", "-O2", "-fPIC", "-shared", "-o", str(marks), str(source)])
        fixed = {
            "NUMBA_CPU_NAME": PROCESSOR,
            "NUMBA_CPU_FEATURES": "",
            "NUMBA_CACHE_DIR": str(cache or folder / "cache"),
            "PYTHONHASHSEED": "0",
        }
        command = [sys.executable, str(COUNTED / "pipelines.py")]
        printed([*command, "-", *names], fixed)
        found = callgrind(folder, ["--instr-atstart=no"], [*command, str(marks), *names], fixed)
        return {name: per_sample(found[name]) for name in names}


def callgrind(
    folder: Path,
    options: list[str],
    command: list[str],
    more: Mapping[str, str] | None = None,
    end: float | None = None,
) -> dict[str, list[tuple[int, int]]]:
    """Run a command; return samples and instructions of both lengths of all that it counts."""
    out = folder / "parts"
    valgrind = ["valgrind", "-q", "--tool=callgrind", f"--callgrind-out-file={out}", *options]
    problems = printed([*valgrind, *command], more, end)
    if problems:
        raise RuntimeError(problems)
    found = defaultdict(list)
    for part in sorted(folder.glob("parts*")):
        for stage, rate, samples, count in PART.findall(part.read_text(encoding="utf-8")):
            if int(rate) == RATE_HZ:
                found[stage].append((int(samples), int(count)))
    return found


def per_sample(counts: list[tuple[int, int]]) -> float:
    """Return the difference of instructions by that of samples, of two lengths."""
    (fewer, short), (more, long) = sorted(counts)
    return round((long - short) / (more - fewer), 2)


def printed(
    command: list[str], more: Mapping[str, str] | None = None, end: float | None = None
) -> str:
    """Run a command that has to succeed, before ``end`` if there is one; return what it prints."""
    environment, left = {**os.environ, **(more or {})}, None
    if end is not None:
        left = max(end - time.monotonic(), 0.0)
    found = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=left)
    if found.returncode:
        raise RuntimeError(f"{command[0]} ended with {found.returncode}: {found.stderr.strip()}")
    return found.stdout


def main() -> int:
    """Print a line for each."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--pipeline", action="append", choices=PIPELINES, default=[])
    parser.add_argument("stage", nargs="*", metavar="STAGE")
    given = parser.parse_args()
    missing = missing_tools()
    if missing:
        print(f"instructions: skipped, {', '.join(missing)} is not installed")
        return 0
    print(f"instructions per sample at {RATE_HZ / 1000:g} kHz; {', '.join(tools().values())}")
    found = of_stages(given.stage or stages()) if given.stage or not given.pipeline else {}
    if given.pipeline:
        found |= of_pipelines(given.pipeline)
    for name, count in found.items():
        print(f"  {name:40} {count:10.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
