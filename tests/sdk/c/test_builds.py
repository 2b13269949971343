"""The C library builds cleanly by every way it is offered, and is clean under the sanitizers."""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import floatref
from floatref.c import amalgamation

ROOT = Path(__file__).parents[3]
STRICT = ("-std=c99", "-O2", "-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror")
PROGRAM = """
#include <stdio.h>
#include <string.h>
#include <floatref.h>
int main(void)
{
    printf("%s %d\\n", fr_version(), fr_real_size() == sizeof(fr_real));
    return strcmp(fr_status_text(FR_OK), fr_status_text(FR_BAD_CONFIG)) == 0;
}
"""
CMAKE = """
cmake_minimum_required(VERSION 3.13)
project(mine C)
find_package(floatref 0.1 REQUIRED)
add_executable(mine mine.c)
target_link_libraries(mine floatref::floatref)
"""


def succeeds(command, **options):
    found = subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)
    assert found.returncode == 0, found.stdout + found.stderr
    return found


def test_the_sources_are_files_and_each_names_its_licence():
    sources = floatref.c_sources()
    files = [sources / "floatref.h", *sorted((sources / "src").iterdir())]
    assert len(files) > 20
    for file in files:
        assert file.read_text(encoding="utf-8").startswith("/* SPDX-License-Identifier: Apache-2.0")
    assert "SPDX-License-Identifier" in (sources / "CMakeLists.txt").read_text(encoding="utf-8")


def test_header_and_cmake_have_one_version():
    header = (floatref.c_sources() / "floatref.h").read_text(encoding="utf-8")
    numbers = re.findall(r"^#define FR_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", header, re.M)
    cmake = (floatref.c_sources() / "CMakeLists.txt").read_text(encoding="utf-8")
    assert f"project(floatref VERSION {'.'.join(numbers)} " in cmake


@pytest.mark.slow
def test_an_installed_package_has_the_sources(tmp_path):
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", tmp_path]
    succeeds(build, cwd=ROOT)
    (wheel,) = tmp_path.glob("*.whl")
    assert wheel.name.endswith("-py3-none-any.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "installed")
    # PYTHONPATH comes before the editable package of the site packages.
    code = "from floatref.c.c_sources import c_sources; print(c_sources())"
    environment = {**os.environ, "PYTHONPATH": str(tmp_path / "installed")}
    folder = Path(succeeds([sys.executable, "-c", code], env=environment).stdout.strip())
    assert folder == tmp_path / "installed" / "floatref" / "c"
    here = {p.relative_to(floatref.c_sources()) for p in floatref.c_sources().rglob("*.[ch]")}
    assert {p.relative_to(folder) for p in folder.rglob("*.[ch]")} == here


def test_nothing_is_allocated_read_or_printed():
    for source in (floatref.c_sources() / "src").glob("*.c"):
        text = source.read_text(encoding="utf-8")
        for word in ("malloc", "free(", "stdio", "locale", "alloca", "errno"):
            assert word not in text, source.name


def test_an_amalgamation_that_cannot_be_written_is_one_line(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert amalgamation.main([str(tmp_path / "file")]) == 2
    assert amalgamation.main([]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert lines[0].endswith("choose another folder")
    assert lines[1].startswith("usage:")


def test_a_cpp_program_takes_the_header(compiler, tmp_path):
    cpp = shutil.which("c++") or pytest.skip("no C++ compiler")
    (tmp_path / "mine.cpp").write_text(f'extern "C" {{}}\n{PROGRAM}')
    strict = ["-std=c++17", "-Wall", "-Wextra", "-pedantic", "-Werror", "-fsyntax-only"]
    succeeds([cpp, *strict, f"-I{floatref.c_sources()}", tmp_path / "mine.cpp"])


@pytest.mark.slow
@pytest.mark.parametrize("name", ["gcc", "clang"])
@pytest.mark.parametrize("macro", [(), ("-DFR_FLOAT",)])
@pytest.mark.parametrize("form", ["sources", "amalgamation"])
def test_every_source_builds_without_a_warning(compiler, tmp_path, name, macro, form):
    program = shutil.which(name) or compiler
    folder = floatref.c_sources()
    files = sorted((folder / "src").glob("*.c"))
    if form == "amalgamation":
        amalgamation.main([str(tmp_path)])
        folder, files = tmp_path, [tmp_path / "floatref.c"]
    for file in files:
        succeeds([program, *STRICT, *macro, f"-I{folder}", "-c", file, "-o", tmp_path / "x.o"])


@pytest.mark.slow
@pytest.mark.parametrize("shared", ["ON", "OFF"])
@pytest.mark.parametrize("single", ["ON", "OFF"])
def test_cmake_installs_a_package_that_others_find(compiler, tmp_path, shared, single):
    cmake = shutil.which("cmake") or pytest.skip("no cmake")
    build, prefix, mine = (tmp_path / name for name in ("build", "prefix", "mine"))
    options = [f"-DBUILD_SHARED_LIBS={shared}", f"-DFLOATREF_FLOAT={single}"]
    options.append(f"-DCMAKE_INSTALL_PREFIX={prefix}")
    succeeds([cmake, "-S", floatref.c_sources(), "-B", build, *options])
    succeeds([cmake, "--build", build, "--target", "install"])
    mine.mkdir()
    (mine / "mine.c").write_text(PROGRAM)
    (mine / "CMakeLists.txt").write_text(CMAKE)
    succeeds([cmake, "-S", mine, "-B", mine / "build", f"-DCMAKE_PREFIX_PATH={prefix}"])
    succeeds([cmake, "--build", mine / "build"])
    assert succeeds([mine / "build" / "mine"]).stdout == "0.1.0 1\n"


@pytest.mark.nightly
@pytest.mark.slow
def test_the_fuzzer_finds_nothing(compiler):
    command = [sys.executable, ROOT / "tests" / "fuzz" / "fuzz_c_library.py", "--minutes", "0.35"]
    assert "calls that did their work" in succeeds(command).stdout


@pytest.mark.nightly
@pytest.mark.slow
def test_the_golden_vectors_are_clean_under_the_sanitizers(compiler):
    found = subprocess.run(
        [compiler, "-print-file-name=libasan.so"], capture_output=True, text=True
    ).stdout.strip()
    if not Path(found).is_file():
        pytest.skip(f"{compiler} has no address sanitizer")
    # As a worker, it would take a library that another run of pytest has built.
    own = {name: value for name, value in os.environ.items() if "XDIST" not in name}
    environment = {
        **own,
        "FLOATREF_C_FLAGS": "-fsanitize=address,undefined -fno-sanitize-recover=all",
        "LD_PRELOAD": found,
        "ASAN_OPTIONS": "detect_leaks=0",
    }
    test = Path(__file__).parent / "test_golden_vectors.py"
    succeeds([sys.executable, "-m", "pytest", "-n0", "-q", test], cwd=ROOT, env=environment)
