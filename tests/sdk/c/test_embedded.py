"""The C library on an emulated Cortex-M: the numbers of the host, and costs that agree."""

import importlib.util
import re
import sys
from pathlib import Path

import numpy as np
import pytest

from floatref.estimators.laser_place.pitching import SLOW_HZ

ROOT = Path(__file__).parents[3]
EMBEDDED = ROOT / ".ci" / "embedded"
PAGES = {"": ROOT / "docs" / "embedded.md", " smoothers": ROOT / "docs" / "embedded-smoothers.md"}
"""Pages by what follows the core in the titles of their tables."""
DEEP = (
    "adaptive",
    "varying_12",
    "adaptive_end",
    "kalman_filter",
    "kalman_lag_1_s",
    "pitch_window_5_s",
)
DEEP += ("road_prior_lag_2_s",)
"""Stages that need more of the stack than the harness does."""
QUICK = (*DEEP, "saturation", "encoder_screening", "usual", "causes", "level")
QUICK += ("high_pass_profile", "seam", "cross_correlation_100_mm", "validity")
LIBM = {"filter", "high_pass", "iri", "timer", "usual", "pitch", "level"}
"""First words of stages whose settings or samples pass through functions of the mathematical
library, which differ by an ulp or two between one machine and another."""
SOLVED = {"level_fit": 1e-9, "road_prior": 1e-7, "kalman_lag": 1e-7}
"""Relative bounds of what an ulp of such a function becomes in a solution by least squares: normal
matrices of condition 1e14 that are corrected twice, and covariances of 1e8."""
BIN_S, WHEELBASE_M, HEIGHT_M = 0.01, 3.0, 0.26
PITCH_RAD = 8.0 * np.finfo(float).eps * HEIGHT_M * (np.pi * SLOW_HZ * BIN_S) ** -2.0 / WHEELBASE_M
"""What rounding makes of a pitch, as in test_modelled_pitch.py: eight passes of filters carry a
rounding of the height by the inverse square of their corner, over the wheelbase. A corner that is
off by an ulp does less. No covariance is inverted, so its condition does not count. It is 1.7e-12
rad, below the 4e-12 that docs/c-library.md states beside the SDK."""
SPANS = ("screening", "saturation", "encoder_screening")
"""Stages without an output where all samples are sound."""
SIZES = {"road_prior": 6, "kalman_lag": 6}
"""Sizes among the fields of an object, of 4 bytes less each on a core."""
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


def value(bits):
    """Return the number that has these bits, in hexadecimal digits."""
    kinds = (np.uint32, np.float32) if len(bits) == 8 else (np.uint64, np.float64)
    return np.array([int(bits, 16)], kinds[0]).view(kinds[1])[0]


def of_stage(stage, table, otherwise):
    """Return what a table has for the first words of a stage."""
    return next((x for words, x in table.items() if stage.startswith(words)), otherwise)


def bound_of(stage, values):
    """Return by how much an output may be another on another machine."""
    if stage.startswith("pitch"):
        return PITCH_RAD
    # An ulp or two of a coefficient, for as long as a filter remembers it: some hundred samples.
    usual = 1e3 * np.finfo(values.dtype).eps
    bound = of_stage(stage, SOLVED, usual) if values.dtype == np.float64 else usual
    return bound * np.abs(values).max()


def assert_same_numbers(stage, found, expected):
    if not stage.startswith((*LIBM, *SOLVED)):
        assert found.bits == expected.bits
        return
    mine, theirs = (np.array([value(b) for b in f.bits]) for f in (found, expected))
    np.testing.assert_allclose(mine, theirs, rtol=0, atol=bound_of(stage, theirs))


@pytest.mark.slow
@pytest.mark.parametrize("stage", board.stages())
def test_a_stage_gives_the_numbers_of_the_host(core, host, stage):
    found = core.run(core.image(stage))
    assert [f.rate for f in found] == [4000, 16000]
    for here, there in zip(found, host.run(stage), strict=True):
        assert there.bytes - here.bytes == 4 * of_stage(stage, SIZES, 0)
        assert here.samples == there.samples
        assert here.ticks >= here.longest > 0
        assert len(here.bits) > 0 or stage in SPANS
        assert_same_numbers(stage, here, there)


@pytest.mark.slow
@pytest.mark.parametrize("stage", DEEP)
def test_the_computed_stack_is_enough_for_what_a_run_takes(core, stage):
    harness = core.run(core.image("nothing"))[0].stack
    image = core.image(stage)
    taken = core.run(image)[0].stack - harness
    computed = stack.deepest(image, core.folder)
    # A run does not go the deepest way, but most of it.
    assert computed / 4 < taken <= computed


@pytest.mark.slow
def test_traced_instructions_are_those_of_the_clock(core):
    for stage in ("varying_12", "adaptive", "kalman_filter", "causes"):
        made = cycles.estimate(core, stage)
        for figures in core.run(core.image(stage, *cycles.SHORT)):
            cost = made[figures.rate]
            pieces = 2
            apart = abs(cost.instructions - figures.instructions) * figures.samples
            assert apart <= pieces * HARNESS
            assert cost.instructions <= cost.fewest <= cost.most <= 4 * cost.instructions


def rows_of(page, title):
    """Return the cells of the table behind a title, by stage."""
    table = page.read_text(encoding="utf-8").partition(f"\n{title}:")[2]
    lines = table.partition("\n\n|")[2].partition("\n\n")[0].splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]
    return {re.match(r"`(\w+)`", each[0])[1]: each for each in cells}


def written(core):
    """Return the cells of both pages for a core, by stage."""
    title = "Cortex-M4F, float" if core.target.single else "Cortex-M7, double"
    return {k: x for more, page in PAGES.items() for k, x in rows_of(page, title + more).items()}


@pytest.mark.slow
def test_the_pages_have_the_figures_of_this_compiler(core):
    cells, empty = written(core), core.sizes(core.image("nothing"))
    for stage in QUICK:
        row = costs.row(core, stage, empty, traced=False)
        # Another version of the compiler is within a tenth.
        assert int(cells[stage][1]) == pytest.approx(row.text, rel=0.1)
        assert cells[stage][3] == costs.cell(row, "object")
        assert int(cells[stage][4]) == pytest.approx(row.stack, rel=0.1)
        shown = [int(x) for x in cells[stage][5].split(", ")]
        for number, rate in zip(shown, (4000, 16000), strict=False):
            assert number == pytest.approx(row.figures[rate].instructions, rel=0.1)


def test_the_pages_have_a_row_for_every_stage():
    rows = [
        name
        for page in PAGES.values()
        for name in re.findall(r"^\| `(?!fr_)(\w+)`", page.read_text(encoding="utf-8"), re.M)
    ]
    plain, smoothers = board.stages(board.STAGES), board.stages(board.SMOOTHERS)
    assert rows == [*plain * 2, *smoothers * 2]


def test_all_that_the_header_declares_has_a_figure():
    measured = {board.stage_kind(stage) for stage in board.stages()}
    assert measured == set(board.kinds())
    assert costs.unmeasured() == []
    assert {"adaptive", "filter", "kalman", "level_fit", "seam", "validity"} <= measured


def test_a_new_object_or_function_of_the_header_is_named(monkeypatch, tmp_path):
    text = (board.LIBRARY / "floatref.h").read_text(encoding="utf-8")
    new = "FR_API size_t fr_new_size(const fr_new_config *config);\n"
    alone = "FR_API fr_status fr_alone(const fr_new_config *config);\n"
    (tmp_path / "floatref.h").write_text(text + new + alone, encoding="utf-8")
    monkeypatch.setattr(costs.board, "LIBRARY", tmp_path)
    assert costs.unmeasured() == ["`fr_new`", "`fr_alone`"]


def test_without_the_tools_the_costs_are_skipped_in_a_line(monkeypatch, capsys):
    monkeypatch.setattr(board.shutil, "which", lambda tool: None)
    assert costs.main([]) == 0
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith("costs on a small core: skipped, arm-none-eabi-gcc")


def test_a_stage_that_is_not_there_is_named_before_anything_is_built(monkeypatch, capsys):
    monkeypatch.setattr(costs.board, "missing_tools", list)
    monkeypatch.delattr(costs.board, "Board")
    assert costs.main(["seam", "seem"]) == 2
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith("seem: no such stage; there are filter_high_pass_1, ")


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


A, B, C, D = range(0x100, 0x108, 2)


@pytest.mark.parametrize(
    ("start", "following", "expected"),
    [
        (A, D + 2, [A, B, C, D]),  # not taken
        (A, A, [A, B, C, D]),  # a loop
        (A, C, [A, B, C, D]),  # back into the middle of itself, not before it
        (0x3FC, 0x400, [0x3FC, 0x3FE]),  # the end of a page
    ],
)
def test_a_block_ends_with_a_branch_or_a_page(start, following, expected):
    plain = dict.fromkeys([A, B, C, 0x3FC, 0x3FE, 0x400], cycles.Instruction("adds", "r1, r2"))
    listing = {**plain, D: cycles.Instruction("bne.n", "100 <x>")}
    assert cycles.block(start, following, listing) == expected
