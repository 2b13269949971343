"""Fuzz channel maps: any bytes are a map, or one `InputError` of one line; so is what it maps.

Run it as `harness` says, with -rss_limit_mb=700. What stands behind a byte 255, which no UTF-8 has,
are the samples and the ticks of the file that is mapped. Mutations put in whole lines of maps, so
that more than the TOML parser is reached.
"""

import random
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np
from harness import fuzz, instrumented, one_line, scratch

with instrumented(include=["floatref", "tomllib"]):
    from floatref import Column, Epoch, NativeClock, NativeFile, Rows, Stream, hookimpl
    from floatref.engine.plugins import plugins
    from floatref.mapping import read_map, read_native
    from floatref.mapping.channel_map.entries import ChannelMap
    from floatref.mapping.clocks.columns import UNKNOWN
    from floatref.mapping.draft.drafting import draft_map

FOLDER = scratch("map")
MAP, SOURCE = FOLDER / "map.toml", FOLDER / "run.mem"
SAMPLES = 64
HEAD = b'format = "floatref-map/1"\n'
LINES = [
    *(b"[[channels]]", b"[[clocks]]", b"[[files]]", b"[source]", b"[setup]", b"[device]"),
    *(b'native = "%s"' % name for name in (b"adc/z", b"laser", b"gps/alt", b"dmi/count", b"t")),
    *(b'channel = "%s"' % name for name in (b"height", b"distance", b"specific_force")),
    *(b'channel = "gnss_height"', b'channel = "angular_rate"', b'axis = "-z"', b'axis = "x"'),
    *(b'unit = "%s"' % name for name in (b"m", b"mm", b"g", b"km/h", b"deg/s", b"counts")),
    *(
        b"scale = 0.5",
        b"offset = -1e30",
        b"sign = -1",
        b"delay_s = 0.01",
        b"wrap = 8",
        b"wrap = 1e18",
    ),
    *(b"missing = [-1, 0]", b"sparse = true", b'track = "left"', b'file = "b"', b'file = ""'),
    *(b'name = "b"', b'path = "run.mem"', b'path = "../x"', b'adapter = "memory"', b'dbc = "x"'),
    *(b'stream = "adc"', b'stream = "gps"', b'stream = "dmi"', b"rate_hz = 10", b'rate_hz = "7/3"'),
    *(
        b'align = "offset"',
        b'align = "pulses"',
        b'align = "gnss"',
        b"offset_s = 1",
        b"drift_ppm = 5",
    ),
    *(b'pulses = "gps/pps"', b'base_pulses = "adc/pps"', b'base_time = "adc/t"', b"start_s = -3"),
    *(b'base_pps = "adc/pps"', b"profile_interval_m = 0.05", b"tracks.left = {}", b"\xff"),
]
SEEDS = (
    HEAD
    + b'[[channels]]\nnative = "laser"\nchannel = "height"\nunit = "mm"\nwrap = 8\nscale = 2.5\n',
    HEAD + b'[[channels]]\nnative = "adc/z"\nchannel = "specific_force"\naxis = "-z"\nunit = "g"\n'
    b'[[channels]]\nnative = "gps/alt"\nchannel = "gnss_height"\nunit = "m"\nsparse = true\n'
    b'[[clocks]]\nstream = "gps"\nalign = "offset"\noffset_s = 0.5\ndrift_ppm = 3\n\xff'
    + np.arange(SAMPLES, dtype=np.float64).tobytes(),
    HEAD + b'[source]\nadapter = "memory"\noptions = { a = "b" }\n[[files]]\nname = "b"\n'
    b'path = "run.mem"\n[[channels]]\nfile = "b"\nnative = "dmi/count"\nchannel = "distance"\n'
    b'unit = "km/h"\n[[clocks]]\nfile = "b"\nstream = "dmi"\nrate_hz = "100/3"\nstart_s = 2\n',
    HEAD + b'[[channels]]\nnative = "adc/z"\nchannel = "vertical_specific_force"\nunit = "g"\n'
    b'[[channels]]\nnative = "gps/alt"\nchannel = "gnss_height"\nunit = "m"\n[[clocks]]\n'
    b'stream = "gps"\nalign = "pulses"\npulses = "gps/pps"\nbase_pulses = "adc/pps"\n',
)


class Memory:
    """The adapter of a file whose samples and ticks are the bytes of an input."""

    name, summary = "memory", "bytes as samples"
    content = b""

    def recognises(self, source: Path) -> bool:
        """Tell whether ``source`` is the one file there is."""
        return source.suffix == ".mem"

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        content = (self.content + bytes(8 * SAMPLES))[: 8 * SAMPLES]
        values = np.frombuffer(content, "<f8")
        ticks = np.frombuffer(content, "<i8")
        names = {"adc": ("z", "pps", "t"), "": ("laser",), "gps": ("alt", "pps"), "dmi": ("count",)}
        clocks = {
            "adc": NativeClock(Fraction(100), epoch=Epoch.LOCAL),
            "": NativeClock(tick_s=Fraction(1, 1000)),
            "gps": NativeClock(tick_s=Fraction(1, 1000), epoch=Epoch.GPS, name="gps"),
            "dmi": NativeClock(name=UNKNOWN),
        }
        stamps = {"": values, "gps": ticks}
        return NativeFile(
            tuple(
                Stream(name, tuple(map(Column, columns)), SAMPLES, clocks[name], rows)
                for name, columns in names.items()
                for rows in [_rows(values, stamps.get(name))]
            )
        )


def _rows(
    values: np.ndarray, ticks: np.ndarray | None
) -> Callable[[Sequence[str]], Iterator[Rows]]:
    def read(names: Sequence[str]) -> Iterator[Rows]:
        for at in range(0, SAMPLES, 24):
            part = slice(at, at + 24)
            yield Rows(dict.fromkeys(names, values[part]), None if ticks is None else ticks[part])

    return read


ADAPTER = Memory()


class Plugin:
    @hookimpl
    def floatref_register_adapters(self, register: Callable[[object], None]) -> None:
        register(ADAPTER)


def read_any(data: bytes) -> None:
    """Read ``data`` as a map, and the file by it; then a draft of the file with its names."""
    text, _, ADAPTER.content = data.partition(b"\xff")
    MAP.write_bytes(text)
    chart = one_line(read_map, MAP)
    if isinstance(chart, ChannelMap):
        one_line(read_native, SOURCE, chart)
    drafted(text)


def drafted(text: bytes) -> None:
    """Raise an error unless the draft of a file with ``text`` for names is a map, too."""
    name, _, unit = text[:80].decode("utf-8", "surrogateescape").partition("\n")
    columns = (Column(name, unit), Column(f"laser {name}", "mm"), Column(f"{name}.height"))
    unique = tuple({column.name: column for column in columns}.values())
    stream = Stream(name, unique, 0, NativeClock(), lambda names: iter(()))
    chart = draft_map(NativeFile((stream,)), Path("run.mem"), "memory")
    MAP.write_bytes(chart.encode())
    if "\n[[channels]]" in chart:
        read_map(MAP)


def mutated(data: bytes, most: int, seed: int) -> bytes:
    """Return ``data`` with a line of a map put in, taken out or put elsewhere, or mutated."""
    chance = random.Random(seed)
    if chance.random() < 0.5:
        import atheris

        return bytes(atheris.Mutate(data, most))
    lines = data.split(b"\n")
    at = chance.randrange(len(lines) + 1)
    if chance.random() < 0.3:
        del lines[at : at + 1]
    elif chance.random() < 0.2:
        lines[at:at] = lines[chance.randrange(len(lines) + 1) :][:5]
    else:
        lines.insert(at, chance.choice(LINES))
    return b"\n".join(lines)[:most]


def main() -> None:
    """Fuzz, with the inputs of the corpus folder, into which a few are put."""
    warnings.simplefilter("error")
    SOURCE.write_bytes(b"")
    plugins().add(Plugin(), "memory")
    fuzz("map", read_any, SEEDS, mutated)


if __name__ == "__main__":
    main()
