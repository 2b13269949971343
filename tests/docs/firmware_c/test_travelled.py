"""The way of the vehicle in the C example, by counts that may be missing."""

import os
import subprocess
from pathlib import Path

import pytest

from floatref import c_sources

SOURCE = Path(__file__).parents[3] / "docs" / "examples" / "firmware_c"
PROGRAM = """
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "waiting.h"

static uint64_t pool[4096];
static size_t used;

void *run_memory(size_t size)
{
    void *memory = pool + used;
    used += size / sizeof *pool + 1u;
    return memory;
}

int main(int argc, char **argv)
{
    static fr_real x[100];
    static uint8_t causes[100];
    int64_t counts[100];
    size_t first = (size_t)atoi(argv[1]), behind = (size_t)atoi(argv[argc - 1]);
    struct vehicle vehicle = {.paths = 1, .samples = 100};
    struct path path = {.vehicle = &vehicle, .of_samples = causes};
    fr_status status = begin_waiting(&vehicle, 100.0);
    vehicle.waiting->force[0] = vehicle.waiting->height[0] = run_memory(sizeof x);
    for (size_t i = 0; i < 100; i++)
        counts[i] = i >= first && i < behind ? FR_NO_COUNT : 10 * (int64_t)i;
    status = status == FR_OK ? store(&path, x, x, counts, 100) : status;
    if (status == FR_OK)
        end_counts(vehicle.waiting);
    printf("%d %zu", status, vehicle.waiting->known);
    for (size_t i = 0; i < vehicle.waiting->known; i++)
        printf(" %lld", (long long)vehicle.waiting->travelled[i]);
    return 0;
}
"""
FLAGS = ("-std=c99", "-O0", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")


@pytest.fixture(scope="module")
def way(tmp_path_factory):
    """Return a function: status and way by counts of 10 a sample, some of which are missing."""
    folder = tmp_path_factory.mktemp("way")
    (folder / "main.c").write_text(PROGRAM, encoding="ascii")
    sources = [folder / "main.c", SOURCE / "waiting.c", SOURCE / "travelled.c"]
    command = [
        os.environ.get("CC", "cc"),
        *FLAGS,
        f"-I{SOURCE}",
        f"-I{c_sources()}",
        *sources,
        "-lm",
    ]
    subprocess.run([*command, "-o", folder / "way"], check=True)

    def run(first, behind):
        found = subprocess.run(
            [folder / "way", str(first), str(behind)], capture_output=True, text=True
        )
        assert (found.returncode, found.stderr) == (0, "")
        status, known, *travelled = map(int, found.stdout.split())
        assert len(travelled) == known
        return status, travelled

    return run


@pytest.mark.parametrize(("first", "behind"), [(1, 1), (1, 3), (40, 60), (95, 99)])
def test_the_vehicle_goes_on_across_missing_counts(way, first, behind):
    assert way(first, behind) == (0, [10 * i for i in range(100)])


def test_behind_the_last_count_the_vehicle_is_where_it_was(way):
    assert way(90, 100) == (0, [10 * min(i, 89) for i in range(100)])


def test_a_run_without_a_first_count_is_refused(way):
    status, travelled = way(0, 3)
    assert (status, travelled) == (7, [])
