"""The page of golden vectors lists them all, and what it says of single precision is so."""

import re
from pathlib import Path

import numpy as np
import pytest

from floatref_conformance import golden

PAGE = Path(__file__).parents[2] / "docs" / "golden-vectors.md"


def rows():
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    cells = ([cell.strip() for cell in line.strip("|").split("|")] for line in lines)
    return {row[0].strip("`"): row[1:] for row in cells if len(row) == 5 and row[0][0] == "`"}


def plain(tex):
    """Return an equation of the table as the vectors spell it."""
    return tex.replace("$", "").replace("\\omega", "w").replace("\\,", " ")


def test_the_table_has_every_vector_with_its_equation_and_signals():
    assert sorted(rows()) == list(golden.names())
    for name, (stage, *columns) in rows().items():
        vector = golden.read(name)
        assert plain(stage).endswith(f"; {vector['equation']}")
        for column, group in zip(columns, ("settings", "inputs", "outputs"), strict=True):
            assert re.findall(r"`(\w+)`", column) == list(vector[group])


def as_printed(x, c, kind):
    """Return HPF_B3S2 by the recursion (A.9) with (A.15), every operation in ``kind``."""
    c, x = kind(c), [kind(value) for value in x]
    one, two = kind(1), kind(2)
    d0, d1, d2 = one + c + c * c, two * (c * c - one), one - c + c * c
    y = [-(d1 + d2) / d0 * x[0]]
    y.append((x[1] - x[0] - (d1 + d2) * y[0]) / d0)
    for k in range(2, len(x)):
        y.append((x[k] - two * x[k - 1] + x[k - 2] - d1 * y[k - 1] - d2 * y[k - 2]) / d0)
    assert all(type(value) is kind for value in y)
    return np.array(y, dtype=float)


@pytest.mark.parametrize(("kind", "passes"), [(np.float64, True), (np.float32, False)])
def test_the_recursion_as_printed_passes_in_double_precision_alone(kind, passes):
    vector = golden.read("hpf-b3s2-slow")
    c = np.tan(np.pi * vector["settings"]["cutoff"] * vector["settings"]["step"])
    expected = np.array(vector["outputs"]["y"])
    error = np.abs(as_printed(vector["inputs"]["x"], c, kind) - expected).max()
    allowed = vector["tolerance"][np.dtype(kind).name] * np.abs(expected).max()
    assert error < allowed if passes else error > 100 * allowed
