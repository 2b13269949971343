"""Fuzz the C example: its JSON and its recording.json, under the sanitizers of the compiler.

    python tests/fuzz/fuzz_firmware_c.py --seconds 20

The program, built by clang where it is installed, reads every input in one process. Our own driver
alone drives it: atheris sees no line of C.
"""

import shutil
import subprocess
from contextlib import suppress
from pathlib import Path

from harness import fuzz, scratch

import floatref

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "docs" / "examples" / "firmware_c"
SOURCES = ("json.c", "json_text.c", "recording.c", "setup.c", "failure.c")
FLAGS = ("-std=c99", "-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
CHANNEL = '{"name": "%s", "track": "left", "unit": "%s", "file": "%s.f64", "rate_hz": 1000, '
SEEDS = (
    b'{"format": "floatref-recording/1", "device": {"vendor": "a"}, "setup": {"profile_interval_m":'
    b' 0.05, "tracks": {"left": {"reference_point_m": [0, 1, 0.5], "laser_offset_m": [1e-1, 0, 0]}'
    b'}, "axles": {"wheelbase_m": 2.5, "front_axle_m": 1}}, "channels": ['
    + ", ".join(
        CHANNEL % (name, unit, name) + '"start_s": -1.5}'
        for name, unit in (("vertical_specific_force", "m/s^2"), ("height", "m"))
    ).encode()
    + b', {"name": "distance", "unit": "m", "file": "d.f64", "time_file": "t.f64"}]}\n',
    rb'["\u00e9\ud83d\ude00\n\"", -0.5e-3, {"a": [[], {}], "b": null, "": true}]',
    b'\xef\xbb\xbf{"seq": 1, "cmd": "run", "recording": "a", "profile": "b"}',
    b"[" * 70 + b"]" * 70,
)


def build(folder: Path, compiler: str, example: Path = EXAMPLE) -> Path:
    """Return the program, built in ``folder`` with the sources in ``example``."""
    program = folder / "firmware-c"
    sources = [Path(__file__).parent / "firmware_c.c", *(example / name for name in SOURCES)]
    places = [f"-I{example}", f"-I{floatref.c_sources()}"]
    command = [compiler, *FLAGS, *places, *map(str, sources), "-lm", "-o", str(program)]
    subprocess.run(command, check=True)
    return program


class Firmware:
    """The running program."""

    def __init__(self, program: Path) -> None:
        """Start it."""
        self._file, self._errors = program.with_name("recording.json"), program.with_name("errors")
        with self._errors.open("wb") as errors:
            command = [str(program), str(self._file)]
            self._process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors, bufsize=0
            )

    def read(self, data: bytes) -> None:
        """Let it read ``data``; AssertionError with the report of the sanitizer if it ends."""
        self._file.write_bytes(data)
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        answer = b""
        with suppress(BrokenPipeError):
            self._process.stdin.write(len(data).to_bytes(4, "little") + data)
            answer = self._process.stdout.read(1)
        if answer != b".":
            self.close()
            raise AssertionError("the program ended at an input")

    def close(self) -> None:
        """End it; AssertionError if it does not end as it should, as for memory not given back."""
        try:
            self._process.communicate(timeout=20.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.communicate()
        if self._process.returncode != 0:
            raise AssertionError(self._errors.read_text(errors="replace"))


def main() -> None:
    """Fuzz."""
    firmware = Firmware(build(scratch("firmware-c"), shutil.which("clang") or "cc"))
    try:
        fuzz("firmware_c", firmware.read, SEEDS)
    finally:
        firmware.close()


if __name__ == "__main__":
    main()
