"""Build the C library for a small core, run a stage of it under emulation, and read what it says.

The boards are QEMU's mps2-an386 (Cortex-M4F) and mps2-an500 (Cortex-M7). An image has one stage of
``stages_of_...c``; the same program runs on the host, for the numbers. Nothing is left behind: the
caller gives the folder.
"""

import re
import shutil
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).parent
LIBRARY = HERE.parents[1] / "sdk" / "floatref" / "c"
PREFIX = "arm-none-eabi-"
TOOLS = (f"{PREFIX}gcc", f"{PREFIX}objdump", f"{PREFIX}size", "qemu-system-arm")
FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-ffunction-sections", "-fdata-sections")
LONGEST_RUN_S = 900
INSTRUCTIONS_PER_TICK = 40
"""An instruction takes 1 ns by `-icount shift=0`, and the clock of both boards has 25 MHz."""
LINE = re.compile(
    r"rate (\d+) bytes (\d+) samples (\d+) ticks (\d+) longest (\d+)\nbits((?: [0-9a-f]+)*)\n"
)
STAGES = tuple(HERE / f"stages_of_{part}.c" for part in ("samples", "sets", "profiles", "sensors"))
SMOOTHERS = tuple(HERE / f"stages_of_{part}.c" for part in ("smoothers", "pitch"))
"""Stages of many samples a section, and in double precision alone."""
HARNESS = tuple(HERE / name for name in ("signals.c", "drive.c", "driven.c"))


@dataclass(frozen=True)
class Target:
    """A core: QEMU's board, flags of the compiler, and whether the library is built in float.

    At the address ``far`` the board has 16 MB beside the memory of the core.
    """

    machine: str
    far: int
    flags: tuple[str, ...]
    single: bool

    @property
    def macros(self) -> tuple[str, ...]:
        """The macro of the precision."""
        return ("-DFR_FLOAT",) if self.single else ()


M4F = Target(
    "mps2-an386",
    0x21000000,
    ("-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"),
    single=True,
)
M7 = Target(
    "mps2-an500",
    0x60000000,
    ("-mcpu=cortex-m7", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv5-d16"),
    single=False,
)


@dataclass(frozen=True)
class Figures:
    """What a run of a stage says at one rate in Hz: bytes of the object, costs, and output bits.

    Ticks are those of all samples, and of the longest push.

    The bytes of stack are those of the whole program, the harness among it, and 0 on the host.
    """

    rate: int
    bytes: int
    samples: int
    ticks: int
    longest: int
    bits: tuple[str, ...]
    stack: int

    @property
    def instructions(self) -> float:
        """Instructions per sample."""
        return self.ticks * INSTRUCTIONS_PER_TICK / self.samples

    @property
    def longest_push(self) -> int:
        """Instructions of the longest push of 10 ms."""
        return self.longest * INSTRUCTIONS_PER_TICK


def missing_tools() -> list[str]:
    """Return the tools that are not installed, the C library for the core among them."""
    missing = [tool for tool in TOOLS if shutil.which(tool) is None]
    if missing:
        return missing
    command = [TOOLS[0], *M4F.flags, "-print-file-name=libc_nano.a"]
    found = subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    return [] if Path(found).is_file() else ["libnewlib-arm-none-eabi"]


def stages(sources: Iterable[Path] = STAGES + SMOOTHERS) -> list[str]:
    """Return the names of the stages that ``sources`` have."""
    text = "".join(source.read_text(encoding="utf-8") for source in sources)
    return re.findall(r"^void stage_(\w+)\(void\)$", text, re.M)


def kinds() -> list[str]:
    """Return what the header of the library has to measure: objects, and functions without one."""
    text = (LIBRARY / "floatref.h").read_text(encoding="utf-8")
    objects = re.findall(r"^FR_API size_t fr_(\w+)_size\(const", text, re.M)
    calls = re.findall(r"^FR_API fr_status fr_(\w+)\(", text, re.M)
    of_objects = tuple(f"{kind}_" for kind in objects)
    return [*objects, *(x for x in calls if x not in objects and not x.startswith(of_objects))]


def stage_kind(stage: str) -> str | None:
    """Return the object or the function that a stage measures, the longest name that fits."""
    names = [kind for kind in kinds() if stage == kind or stage.startswith(f"{kind}_")]
    return max(names, key=len, default=None)


def quiet(command: list[str]) -> str:
    """Run a command that has to succeed without a warning; return what it prints."""
    found = subprocess.run(command, capture_output=True, text=True, timeout=300)
    if found.returncode != 0 or found.stderr:
        raise RuntimeError(f"{' '.join(command)}\n{found.stdout}{found.stderr}")
    return found.stdout


def read(text: str) -> list[Figures]:
    """Return the figures of all lines of a run; RuntimeError where the text is another."""
    lines, _, used = text.partition("stack ")
    if LINE.sub("", lines) or not re.fullmatch(r"(\d+\n)?", used):
        raise RuntimeError(f"the program says: {text}")
    stack = int(used or 0)
    found = []
    for match in LINE.finditer(lines):
        rate, size, samples, ticks, longest = map(int, match.groups()[:5])
        bits = tuple(match[6].split())
        found.append(Figures(rate, size, samples, ticks, longest, bits, stack))
    return found


class Board:
    """A core with the library built for it, in ``folder``."""

    def __init__(self, target: Target, folder: Path) -> None:
        """Build the library."""
        self.target, self.folder = target, folder
        folder.mkdir(parents=True, exist_ok=True)
        for source in sorted((LIBRARY / "src").glob("*.c")):
            self._compile(source, source.stem)
        for source in (*HARNESS, *STAGES, *SMOOTHERS, HERE / "mps2.c"):
            self._compile(source, source.stem)

    def _compile(self, source: Path, stem: str, *macros: str) -> Path:
        target = self.target
        made = self.folder / f"{stem}.o"
        command = [TOOLS[0], *FLAGS, *target.flags, *target.macros, *macros, "-Wall", "-Wextra"]
        command += ["-fstack-usage", f"-I{LIBRARY}", f"-I{HERE}", "-c", str(source)]
        quiet([*command, "-o", str(made)])
        return made

    def image(self, stage: str, *macros: str) -> Path:
        """Return the program that has one stage."""
        self._compile(HERE / "pieces.c", "pieces", f"-DSTAGE=stage_{stage}", *macros)
        made = self.folder / f"{stage}.elf"
        objects = sorted(p for p in self.folder.glob("*.o"))
        command = [TOOLS[0], *self.target.flags, "-nostartfiles", "--specs=nano.specs"]
        command += [f"-Wl,--defsym=board_far={self.target.far:#x}", "-Wl,--gc-sections"]
        command += ["-T", str(HERE / "mps2.ld"), *map(str, objects), "-lm"]
        quiet([*command, "-o", str(made)])
        return made

    def emulation(self, image: Path) -> list[str]:
        """Return the command that runs a program, one instruction in 1 ns."""
        board = ["-M", self.target.machine, "-nographic", "-monitor", "none", "-serial", "none"]
        output = ["-semihosting-config", "enable=on,target=native"]
        return [TOOLS[3], *board, *output, "-icount", "shift=0", "-kernel", str(image)]

    def run(self, image: Path) -> list[Figures]:
        """Run a program under emulation."""
        # QEMU prints what the program says on its error output.
        found = subprocess.run(
            self.emulation(image), capture_output=True, text=True, timeout=LONGEST_RUN_S, check=True
        )
        return read(found.stdout + found.stderr)

    def sizes(self, image: Path) -> tuple[int, int]:
        """Return bytes of text and of data."""
        text, data, *_ = quiet([TOOLS[2], str(image)]).splitlines()[1].split()
        return int(text), int(data)


class Host:
    """This machine, with the library built in the precision of a core, in ``folder``."""

    def __init__(self, target: Target, folder: Path, compiler: str = "cc") -> None:
        """Build the library."""
        self.folder, self.command = folder, [compiler, *FLAGS, *target.macros]
        self.command += [f"-I{LIBRARY}", f"-I{HERE}"]
        folder.mkdir(parents=True, exist_ok=True)
        self.objects: list[Path] = []
        library = sorted((LIBRARY / "src").glob("*.c"))
        for source in (*library, *HARNESS, *STAGES, *SMOOTHERS, HERE / "host.c"):
            self.objects.append(folder / f"{source.stem}.o")
            quiet([*self.command, "-c", str(source), "-o", str(self.objects[-1])])

    def run(self, stage: str, *macros: str) -> list[Figures]:
        """Run a stage; its ticks are 0."""
        made = self.folder / stage
        sources = [str(HERE / "pieces.c"), *map(str, self.objects), "-lm"]
        quiet([*self.command, f"-DSTAGE=stage_{stage}", *macros, *sources, "-o", str(made)])
        return read(quiet([str(made)]))
