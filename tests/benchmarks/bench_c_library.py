"""Time the stages of the C library beside the compiled kernels of the SDK, in turns, in one run.

The library is built from its amalgamation by ``cc -O3 -march=native``, or by the compiler ``CC``
and with the flags that are given, twice: with ``-ffp-contract=off``, as it gives the bits of the
SDK's equations, and with ``-ffp-contract=fast``, which fuses products and sums as the kernels do.
Prints ns per sample of both and of the kernels, the lowest median of five passes, and the median of
the ratios of neighbours; below 1 the C library is faster. Samples of the IRI are points. Arrays
have 16000 samples, a second of a wheel path, so that a call from Python, which is not the
library's, takes 0.03 ns of a sample and less; they are in the cache. Run as
``python tests/benchmarks/bench_c_library.py``.
"""

import os
import re
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import cffi
import numpy as np
from timing import in_turns, ratio

import floatref
from floatref.c import amalgamation
from floatref.kernels import local_suppression as suppression
from floatref.kernels import matched_high_pass as matched
from floatref.kernels import memories, motion, schedule, state_variable, varying
from floatref.measures.roughness.golden_car import car_response
from floatref.measures.roughness.quarter_car import GOLDEN_CAR, KMH
from floatref.stages.speed import progress_speed
from floatref.values.arrays import FloatArray, new_record

COUNT, REPEATS, ROUNDS, PASSES = 16_000, 12, 15, 5
CONTRACTS = ("off", "fast")
RATE_HZ, COUNT_M, INTERVAL_M, WINDOW = 16_000.0, 0.001, 0.025, 800
COMPILER = os.environ.get("CC", "cc")
Call = Callable[[], object]


class Library:
    """The C library, with one object of a kind for each call that is timed."""

    def __init__(self, folder: Path, flags: list[str]) -> None:
        """Build it in ``folder``, which is made."""
        folder.mkdir()
        amalgamation.main([str(folder)])
        command = [COMPILER, "-std=c99", *flags, "-fPIC", "-shared", "-o", f"{folder}/c.so"]
        subprocess.run([*command, f"{folder}/floatref.c", "-lm"], check=True)
        text = (folder / "floatref.h").read_text(encoding="utf-8")
        plain = re.sub(r"^#include .*$", "", text, flags=re.M)
        command = [COMPILER, "-E", "-P", "-DFR_API=", "-"]
        found = subprocess.run(command, input=plain, capture_output=True, text=True, check=True)
        self.ffi = cffi.FFI()
        self.ffi.cdef(found.stdout)
        self.lib = self.ffi.dlopen(f"{folder}/c.so")
        self.kept: list[object] = []

    def call(
        self, kind: str, signals: list[np.ndarray], outputs: int = 1, **settings: float
    ) -> Call:
        """Return one push of ``signals`` into a new object."""
        ffi, out = self.ffi, self.ffi.new(f"fr_{kind} **")
        config = ffi.new(f"fr_{kind}_config *")
        config[0] = getattr(self.lib, f"fr_{kind}_defaults")()
        for name, value in settings.items():
            inner, _, field = name.rpartition("__")
            setattr(getattr(config, inner) if inner else config, field, value)
        memory = ffi.new("uint64_t[]", getattr(self.lib, f"fr_{kind}_size")(config) // 8 + 1)
        init = getattr(self.lib, f"fr_{kind}_init")
        assert init(memory, ffi.sizeof(memory), config, out) == 0, kind
        results = [ffi.new("double[]", 2 * COUNT) for _ in range(outputs)]
        push, written = getattr(self.lib, f"fr_{kind}_push"), ffi.new("size_t *")
        inputs = [
            ffi.from_buffer("int64_t[]" if x.dtype == np.int64 else "double[]", x) for x in signals
        ]
        self.kept += [memory, config]
        arguments = out[0], *inputs, COUNT, *results, 2 * COUNT, written

        def once() -> None:
            assert push(*arguments) == 0

        return once

    def frequencies(self, speed: FloatArray) -> Call:
        """Return the cut-off (5.3) of ``speed``."""
        config, y = self.ffi.new("fr_cut_off_config *"), self.ffi.new("double[]", COUNT)
        config[0] = self.lib.fr_cut_off_defaults()
        x, written = self.ffi.from_buffer("double[]", speed), self.ffi.new("size_t *")
        call = self.lib.fr_cut_off_frequency
        return lambda: call(config, x, COUNT, y, COUNT, written)


def pairs(library: Library) -> dict[str, tuple[Call, Call]]:
    """Return, by stage, the call of the C library and that of the kernels."""
    rng = np.random.default_rng(0)
    x, h, y, c = (np.ascontiguousarray(row) for row in rng.standard_normal((4, COUNT)))
    speed = 20.0 + 0.5 * np.sin(np.arange(COUNT) / 500.0)
    # All pushes have the same counts: a stretch that is driven again and again finds no new point.
    counts = np.rint(np.cumsum(speed) / RATE_HZ / COUNT_M).astype(np.int64)
    cutoff, step = floatref.AdaptiveCutOff().frequency(speed), 1.0 / RATE_HZ
    schedule.tangents(cutoff, step, c)
    encoder = {"rate_hz": RATE_HZ, "metres_per_count": COUNT_M}
    fixed = np.tan(np.pi * 0.45 * step)
    fixed_at, at = {"step": step, "cutoff": 0.45}, {"step": step}
    made = {}
    for name, kernel, settings in (
        ("HPF_B3S1", "high_pass_1", {}),
        ("HPF_B3S2", "high_pass_2", {"order": 2}),
        ("LPF_B3S1", "low_pass_1", {"passes": 2}),
        ("LPF_B3S2", "low_pass_2", {"order": 2, "passes": 2}),
    ):
        memory, run = new_record(memories.STATE_VARIABLE), getattr(state_variable, kernel)
        made[name] = (
            library.call("filter", [x], **fixed_at, **settings),
            lambda run=run, memory=memory: run(x, y, memory, fixed, False),
        )
    for sections, orders in (1, "1"), (2, "2"), (3, "12"), (4, "21"):
        states = [new_record(memories.VARYING) for _ in orders]
        run = getattr(varying, f"high_pass_{orders}")

        def both(run=run, states=states) -> None:
            schedule.tangents(cutoff, step, c)
            run(x, y, c, *states, False)

        made[f"varying, sections {orders}"] = (
            library.call("varying", [x, cutoff], sections=sections, **at),
            both,
        )
    integrator, controller = new_record(memories.INTEGRATOR), new_record(memories.CONTROLLER)
    observer = new_record(memories.OBSERVER)

    def observe() -> None:
        schedule.tangents(cutoff, step, c)
        matched.observe(x, h, c, y, observer, step)

    schedule_of = 0.45, 105.91, 2.778, 2.5
    gains = 4.4704, 0.001, 0.834 * step
    past = np.zeros(WINDOW)
    modes = GOLDEN_CAR.modes(INTERVAL_M / (80.0 * KMH), 1000.0)
    return made | {
        "integral": (
            library.call("integral", [x], step_s=step),
            lambda: motion.integrate(x, y, integrator, step / 2.0),
        ),
        "travel speed": (
            library.call("travel_speed", [counts], **encoder, back=1),
            lambda: progress_speed(np.concatenate((past, counts * COUNT_M)), WINDOW, 0.05),
        ),
        "cut-off (5.3)": (
            library.frequencies(speed),
            lambda: schedule.frequencies(speed, y, *schedule_of),
        ),
        "local suppression": (
            library.call("local_suppression", [x, speed], rate_hz=RATE_HZ),
            lambda: suppression.hold_at_zero(x, speed, y, controller, *gains),
        ),
        "matched high-pass": (
            library.call("matched_high_pass", [x, h, cutoff], rate_hz=RATE_HZ),
            observe,
        ),
        "IRI, per point": (
            library.call("iri", [x], interval_m=INTERVAL_M),
            lambda: car_response(x, 10, 0.0, 1.0 / INTERVAL_M, modes, np.zeros(4), y[:-1]),
        ),
        "adaptive set": adaptive(library, x, h, counts),
    }


def adaptive(
    library: Library, x: FloatArray, h: FloatArray, counts: np.ndarray
) -> tuple[Call, Call]:
    """Return the whole of 5.7 up to the points: speed, cut-off, three filters, two integrals."""
    encoder = {"travel__rate_hz": RATE_HZ, "travel__metres_per_count": COUNT_M}
    mine = library.call(
        "adaptive", [x, h, counts], 2, interval_m=INTERVAL_M, travel__back=1, **encoder
    )
    step, past = 1.0 / RATE_HZ, np.zeros(WINDOW)
    filters = [new_record(memories.VARYING) for _ in range(4)]
    first, second = (new_record(memories.INTEGRATOR) for _ in range(2))
    f, c, v, r, z = np.empty((5, counts.size))
    sample, part, points = np.empty(COUNT, np.int64), np.empty(COUNT), np.empty(COUNT)

    def theirs() -> None:
        distance = counts * COUNT_M
        speed = progress_speed(np.concatenate((past, distance)), WINDOW, 0.05)
        schedule.frequencies(speed, f, 0.45, 105.91, 2.778, 2.5)
        schedule.tangents(f, step, c)
        varying.high_pass_1(x, v, c, filters[0], False)
        motion.integrate(v, v, first, step / 2.0)
        varying.high_pass_2(v, r, c, filters[1], False)
        motion.integrate(r, r, second, step / 2.0)
        varying.high_pass_12(h, z, c, filters[2], filters[3], False)
        np.subtract(r, z, out=z)
        found = motion.find_points(distance, 1e9, INTERVAL_M, 0, sample, part)
        motion.read_at(z[0], z[1:], sample[:found], part[:found], points[:found])

    return mine, theirs


def repeated(call: Call) -> Call:
    """Return ``call`` many times, so that the clock has something to measure."""

    def many() -> None:
        for _ in range(REPEATS):
            call()

    return many


def best(passes: list[list[float]]) -> float:
    """Return the lowest median of passes, in ns per sample."""
    return min(statistics.median(times) for times in passes) / REPEATS / COUNT * 1e9


def main(flags: list[str]) -> None:
    """Print a line for each stage."""
    with tempfile.TemporaryDirectory(prefix="floatref-c-") as folder:
        # The memory of the objects is that of the libraries, which therefore stay.
        libraries = [Library(Path(folder) / c, [*flags, f"-ffp-contract={c}"]) for c in CONTRACTS]
        made = [pairs(library) for library in libraries]
        built = " ".join([COMPILER, *flags])
        print(f"{built}; ns per sample of C, C fused, numba; ratios of C to numba")
        for name, (exact, theirs) in made[0].items():
            calls = [repeated(call) for call in (exact, made[1][name][0], theirs)]
            runs = [in_turns(*calls, rounds=ROUNDS) for _ in range(PASSES)]
            columns = [best([run[k] for run in runs]) for k in range(3)]
            columns += [statistics.median(ratio(run[k], run[2]) for run in runs) for k in range(2)]
            print(f"  {name:24s}" + "".join(f" {x:6.2f}" for x in columns), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:] or ["-O3", "-march=native"])
