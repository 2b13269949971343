"""Build the C library for a small core, run a stage of it under emulation, and read what it says.

The boards are QEMU's mps2-an386 (Cortex-M4F) and mps2-an500 (Cortex-M7). An image has one stage of
``stages.c``; the same program runs on the host, for the numbers. Nothing is left behind: the caller
gives the folder.
"""

import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).parent
LIBRARY = HERE.parents[1] / "sdk" / "floatref" / "c"
PREFIX = "arm-none-eabi-"
TOOLS = (f"{PREFIX}gcc", f"{PREFIX}objdump", f"{PREFIX}size", "qemu-system-arm")
FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-ffunction-sections", "-fdata-sections")
INSTRUCTIONS_PER_TICK = 40
"""An instruction takes 1 ns by `-icount shift=0`, and the clock of both boards has 25 MHz."""
LINE = re.compile(r"rate (\d+) bytes (\d+) samples (\d+) ticks (\d+)\nbits((?: [0-9a-f]+)*)\n")


@dataclass(frozen=True)
class Target:
    """A core: QEMU's board, flags of the compiler, and whether the library is built in float."""

    machine: str
    flags: tuple[str, ...]
    single: bool

    @property
    def macros(self) -> tuple[str, ...]:
        """The macro of the precision."""
        return ("-DFR_FLOAT",) if self.single else ()


M4F = Target(
    "mps2-an386",
    ("-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"),
    single=True,
)
M7 = Target(
    "mps2-an500", ("-mcpu=cortex-m7", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv5-d16"), single=False
)


@dataclass(frozen=True)
class Figures:
    """What a run of a stage says at one rate in Hz: bytes of the object, costs, and output bits.

    The bytes of stack are those of the whole program, the harness among it, and 0 on the host.
    """

    rate: int
    bytes: int
    samples: int
    ticks: int
    bits: tuple[str, ...]
    stack: int

    @property
    def instructions(self) -> float:
        """Instructions per sample."""
        return self.ticks * INSTRUCTIONS_PER_TICK / self.samples


def missing_tools() -> list[str]:
    """Return the tools that are not installed, the C library for the core among them."""
    missing = [tool for tool in TOOLS if shutil.which(tool) is None]
    if missing:
        return missing
    command = [TOOLS[0], *M4F.flags, "-print-file-name=libc_nano.a"]
    found = subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    return [] if Path(found).is_file() else ["libnewlib-arm-none-eabi"]


def stages() -> list[str]:
    """Return the names of the stages that ``stages.c`` has."""
    names = re.findall(r"^void stage_(\w+)\(void\)$", (HERE / "stages.c").read_text(), re.M)
    return [name for name in names if name != "nothing"]


def kinds() -> list[str]:
    """Return the kinds of objects that the header of the library declares."""
    return re.findall(
        r"^FR_API fr_status fr_(\w+)_init\(", (LIBRARY / "floatref.h").read_text(), re.M
    )


def stage_kind(stage: str) -> str | None:
    """Return the kind of object that a stage measures, or None where it has no object."""
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
        rate, size, samples, ticks = map(int, match.groups()[:4])
        found.append(Figures(rate, size, samples, ticks, tuple(match[5].split()), stack))
    return found


class Board:
    """A core with the library built for it, in ``folder``."""

    def __init__(self, target: Target, folder: Path) -> None:
        """Build the library."""
        self.target, self.folder = target, folder
        folder.mkdir(parents=True, exist_ok=True)
        for source in sorted((LIBRARY / "src").glob("*.c")):
            self._compile(source, source.stem)
        self._compile(HERE / "signals.c", "signals")
        self._compile(HERE / "mps2.c", "mps2")

    def _compile(self, source: Path, stem: str, *macros: str) -> Path:
        target = self.target
        made = self.folder / f"{stem}.o"
        command = [TOOLS[0], *FLAGS, *target.flags, *target.macros, *macros, "-Wall", "-Wextra"]
        command += ["-fstack-usage", f"-I{LIBRARY}", f"-I{HERE}", "-c", str(source)]
        quiet([*command, "-o", str(made)])
        return made

    def image(self, stage: str, *macros: str) -> Path:
        """Return the program that has one stage."""
        self._compile(HERE / "stages.c", "stages", f"-DSTAGE=stage_{stage}", *macros)
        made = self.folder / f"{stage}.elf"
        objects = sorted(p for p in self.folder.glob("*.o"))
        command = [TOOLS[0], *self.target.flags, "-nostartfiles", "--specs=nano.specs"]
        command += ["-T", str(HERE / "mps2.ld"), "-Wl,--gc-sections", *map(str, objects), "-lm"]
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
            self.emulation(image), capture_output=True, text=True, timeout=120, check=True
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
        self.objects = [HERE / "signals.c", HERE / "host.c"]
        for source in sorted((LIBRARY / "src").glob("*.c")):
            self.objects.append(folder / f"{source.stem}.o")
            quiet([*self.command, "-c", str(source), "-o", str(self.objects[-1])])

    def run(self, stage: str) -> list[Figures]:
        """Run a stage; its ticks are 0."""
        made = self.folder / stage
        sources = [str(HERE / "stages.c"), *map(str, self.objects), "-lm"]
        quiet([*self.command, f"-DSTAGE=stage_{stage}", *sources, "-o", str(made)])
        return read(quiet([str(made)]))
