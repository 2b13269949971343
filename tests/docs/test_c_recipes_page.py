"""The recipes for the C library: each program is built and run, and the table is the header's."""

import importlib
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref.measures import iri

ROOT = Path(__file__).parents[2]
RECIPES = ROOT / "docs" / "examples" / "c_recipes"
PAGE = (ROOT / "docs" / "c-recipes.md").read_text(encoding="utf-8")
HEADER = (floatref.c_sources() / "floatref.h").read_text(encoding="utf-8")
COMPILERS = ("cc", "c++")
MONO = ("mcs", "mono")
CALL = {
    "size_t": "Unsigned Pointer-sized Integer",
    "fr_status": "I32",
    "const char": "C String Pointer",
}
"""What a function returns, in LabVIEW."""


def performed(monkeypatch, folder, text):
    """Run the commands of ``text`` beside the recipes; the differences from what it shows."""
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    consoles = importlib.import_module("consoles")
    shutil.copytree(RECIPES, folder, dirs_exist_ok=True)
    return consoles.differences(text, consoles.performed(text, consoles.Shell(folder)))


def without(programs):
    return next((name for name in programs if shutil.which(name) is None), None)


@pytest.mark.posix
@pytest.mark.slow
def test_the_recipes_in_cpp_and_python_print_what_the_page_shows(monkeypatch, tmp_path):
    if without(COMPILERS):
        pytest.skip(f"no C++ compiler: {without(COMPILERS)} is not found")
    others = re.sub(r"^## C#\n.*?(?=^## )", "", PAGE, flags=re.M | re.S)
    assert performed(monkeypatch, tmp_path, others) == []
    shown = re.findall(r"^IRI .*$", PAGE, re.M)
    elevation = np.loadtxt(tmp_path / "elevation.txt")
    assert set(shown) == {f"IRI {iri(elevation, 0.025):.3f} m/km"}


@pytest.mark.posix
@pytest.mark.slow
def test_the_recipe_in_csharp_prints_what_the_page_shows(monkeypatch, tmp_path):
    missing = without((*COMPILERS, *MONO))
    if missing:
        pytest.skip(f"no C# by mono: {missing} is not found")
    first = PAGE.partition("## C++17")[0]
    (csharp,) = re.findall(r"^## C#\n.*?(?=^## )", PAGE, re.M | re.S)
    assert performed(monkeypatch, tmp_path, first + csharp) == []


@pytest.mark.posix
@pytest.mark.slow
def test_the_wrapper_is_clean_frees_its_memory_and_copies_a_state(tmp_path):
    if without(COMPILERS):
        pytest.skip(f"no C++ compiler: {without(COMPILERS)} is not found")
    shutil.copy(RECIPES / "floatref.hpp", tmp_path)
    (tmp_path / "copy.cpp").write_text(COPY)
    sources, include = floatref.c_sources() / "src", f"-I{floatref.c_sources()}"
    strict = ["-Wall", "-Wextra", "-pedantic", "-Werror"]
    commands = [
        ["cc", "-std=c99", "-c", include, *map(str, sorted(sources.glob("*.c")))],
        ["c++", "-std=c++17", *strict, include, "-c", "copy.cpp"],
        ["sh", "-c", "c++ *.o -lm -o copy"],
        ["./copy"],
    ]
    for command in commands:
        subprocess.run(command, cwd=tmp_path, check=True)


COPY = """
#include "floatref.hpp"
int main()
{
    fr_filter_config config = fr_filter_defaults();
    config.step = 0.01;
    config.cutoff = 0.45;
    floatref::filter one(config);
    fr_real x[3] = {1, 2, 4}, y[3], z[3];
    std::size_t made = 0;
    floatref::check(fr_filter_push(one.get(), x, 3, y, 3, &made));
    floatref::filter two = one;
    floatref::check(fr_filter_push(one.get(), x, 3, y, 3, &made));
    floatref::check(fr_filter_push(two.get(), x, 3, z, 3, &made));
    config.step = 0;
    try {
        floatref::filter bad(config);
    } catch (const floatref::error &error) {
        return error.status == FR_BAD_CONFIG && y[2] == z[2] ? 0 : 1;
    }
    return 1;
}
"""


def test_every_piece_on_the_page_is_in_the_recipes():
    programs = "\n".join(p.read_text(encoding="utf-8") for p in RECIPES.iterdir())
    pieces = re.findall(r"^```(?:cpp|python|csharp)\n(.*?)^```$", PAGE, re.M | re.S)
    assert len(pieces) == 4
    for piece in pieces:
        assert piece in programs


def test_the_table_for_labview_is_that_of_the_header():
    rows = re.findall(r"^\| `(fr_\w+)` \| (.*?) \| (.*) \|$", PAGE, re.M)
    assert len(rows) >= 7
    for name, returns, arguments in rows:
        result, declared = re.search(rf"FR_API ([\w *]+?) ?{name}\((.*?)\);", HEADER, re.S).groups()
        assert returns.startswith(CALL[result.strip(" *")])
        names = [part.split()[-1].lstrip("*") for part in declared.split(",") if part != "void"]
        shown = re.findall(r"`(\w+)`", arguments)
        assert shown == names, name
