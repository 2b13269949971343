"""The C library on an emulated Cortex-M: the numbers of the host, and costs that agree."""

import importlib.util
import re
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[3]
EMBEDDED = ROOT / ".ci" / "embedded"
PAGE = ROOT / "docs" / "embedded.md"
QUICK = ("adaptive", "varying_12", "adaptive_end")
LIBM = {"filter", "high_pass_set", "iri", "timer"}
"""First words of stages whose settings or samples pass through functions of the mathematical
library, which differ by an ulp or two between one machine and another."""
HARNESS = 3 * 40
"""Instructions around a piece that the clock may count, and the length of its tick twice."""


def load(name):
    """Return a module of ``.ci/embedded``, which is no package."""
    spec = importlib.util.spec_from_file_location(name, EMBEDDED / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    with pytest.MonkeyPatch.context() as patched:
        patched.syspath_prepend(str(EMBEDDED))
        patched.setitem(sys.modules, name, module)
        spec.loader.exec_module(module)
    return module


board, cycles, stack, costs = map(load, ("board", "cycles", "stack", "costs"))


@pytest.fixture(scope="module", params=["M4F", "M7"])
def core(request, tmp_path_factory):
    """Return the library built for a core; without the tools the tests are left out."""
    missing = board.missing_tools()
    if missing:
        pytest.skip(f"{', '.join(missing)} is not installed")
    return board.Board(getattr(board, request.param), tmp_path_factory.mktemp(request.param))


@pytest.fixture(scope="module")
def host(core, compiler, tmp_path_factory):
    """Return this machine with the library in the precision of the core."""
    return board.Host(core.target, tmp_path_factory.mktemp("host"), compiler)


def value(bits, single):
    """Return the number that has these bits, in hexadecimal digits."""
    return np.array([int(bits, 16)], np.uint32 if single else np.uint64).view(
        np.float32 if single else np.float64
    )[0]


def assert_same_numbers(core, stage, found, expected):
    if not any(stage.startswith(word) for word in LIBM):
        assert found.bits == expected.bits
        return
    single = core.target.single
    mine, theirs = ([float(value(b, single)) for b in f.bits] for f in (found, expected))
    # An ulp or two of a coefficient, for as long as a filter remembers it: some hundred samples.
    bound = 1e3 * np.finfo(np.float32 if single else np.float64).eps * np.abs(theirs).max()
    np.testing.assert_allclose(mine, theirs, rtol=0, atol=bound)


@pytest.mark.slow
@pytest.mark.parametrize("stage", board.stages())
def test_a_stage_gives_the_numbers_of_the_host(core, host, stage):
    found = core.run(core.image(stage))
    assert [f.rate for f in found] == [4000, 16000]
    for here, there in zip(found, host.run(stage), strict=True):
        assert here.bytes == there.bytes
        assert here.samples == there.samples
        assert here.ticks > 0
        assert len(here.bits) > 0 or stage == "screening"
        assert_same_numbers(core, stage, here, there)


@pytest.mark.slow
@pytest.mark.parametrize("stage", QUICK)
def test_the_computed_stack_is_enough_for_what_a_run_takes(core, stage):
    harness = core.run(core.image("nothing"))[0].stack
    image = core.image(stage)
    taken = core.run(image)[0].stack - harness
    computed = stack.deepest(image, core.folder)
    # A run does not go the deepest way, but most of it.
    assert computed / 4 < taken <= computed


@pytest.mark.slow
def test_traced_instructions_are_those_of_the_clock(core):
    for stage in ("varying_12", "adaptive"):
        made = cycles.estimate(core, stage)
        for figures in core.run(core.image(stage, *cycles.SHORT)):
            cost = made[figures.rate]
            pieces = 2
            apart = abs(cost.instructions - figures.instructions) * figures.samples
            assert apart <= pieces * HARNESS
            assert cost.instructions <= cost.fewest <= cost.most <= 4 * cost.instructions


@pytest.mark.slow
def test_the_page_has_the_figures_of_this_compiler(core):
    text = PAGE.read_text(encoding="utf-8")
    title = "Cortex-M4F, float" if core.target.single else "Cortex-M7, double"
    table = text.partition(f"\n{title}:")[2].partition("\n\n|")[2].partition("\n\n")[0]
    empty = core.sizes(core.image("nothing"))
    for stage in QUICK:
        (line,) = [x for x in table.splitlines() if x.startswith(f"| `{stage}`")]
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        row = costs.row(core, stage, empty, traced=False)
        # Another version of the compiler is within a tenth.
        assert int(cells[1]) == pytest.approx(row.text, rel=0.1)
        assert int(cells[4]) == pytest.approx(row.stack, rel=0.1)
        shown = [int(x) for x in cells[5].split(", ")]
        for number, rate in zip(shown, (4000, 16000), strict=False):
            assert number == pytest.approx(row.figures[rate].instructions, rel=0.1)


def test_the_page_has_a_row_for_every_stage():
    rows = re.findall(r"^\| `(\w+)`", PAGE.read_text(encoding="utf-8"), re.M)
    assert rows == board.stages() * 2


def test_an_object_of_the_header_has_a_figure_or_is_named():
    measured = {board.stage_kind(stage) for stage in board.stages()} - {None}
    named = {name.strip("`").removeprefix("fr_") for name in costs.unmeasured()}
    assert measured | named == set(board.kinds())
    assert not measured & named
    assert {"adaptive", "adaptive_set", "filter", "iri"} <= measured


def test_without_the_tools_the_costs_are_skipped_in_a_line(monkeypatch, capsys):
    monkeypatch.setattr(board.shutil, "which", lambda tool: None)
    assert costs.main([]) == 0
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith("costs on a small core: skipped, arm-none-eabi-gcc")


@pytest.mark.parametrize(
    ("name", "operands", "taken", "expected"),
    [
        ("adds", "r1, r2, #1", False, (1, 1)),
        ("ldr.w", "r3, [r4, #8]", False, (1, 2)),
        ("bne.n", "1ba0 <x>", False, (1, 1)),
        ("bne.n", "1ba0 <x>", True, (2, 4)),
        ("vdiv.f32", "s0, s1, s2", False, (14, 15)),
        ("vdivne.f32", "s0, s1, s2", False, (14, 15)),
        ("vldr", "s0, [r0]", False, (2, 2)),
        ("vldr", "d0, [r0]", False, (3, 3)),
        ("vadd.f32", "s0, s1, s2", False, (1, 2)),
        ("stmdb", "sp!, {r4, r5, r6, lr}", False, (5, 5)),
        ("ldmia.w", "sp!, {r4, r5, pc}", True, (5, 7)),
        ("vpush", "{d8-d15}", False, (17, 17)),
    ],
)
def test_cycles_are_those_of_the_manual(name, operands, taken, expected):
    assert cycles.cycles(cycles.Instruction(name, operands), taken) == expected
