"""A kernel loads without BLAS and with one refresh; code of others finds both as before."""

import json
import os
import subprocess
import sys

PROGRAM = """
import json
import sys
import numpy as np
from floatref.kernels.compiling import compiled

@compiled
def total(x) -> float:
    result = 0.0
    for k in range(x.size):
        result += x[k]
    return result

@compiled
def longest(x) -> float:
    result = 0.0
    for k in range(x.size):
        result = max(result, x[k])
    return result

found = [total(np.ones(3)), longest(np.ones(3))]
from numba.core.cpu import CPUContext
counted, refresh = [], CPUContext.refresh
CPUContext.refresh = lambda context: (counted.append(1), refresh(context))
found += [total(np.ones(3, np.float32)), longest(np.ones(3, np.float32))]
hits = [len(k.dispatcher().stats.cache_hits) for k in (total, longest)]
said = {"found": found, "hits": hits, "refreshes": len(counted)}
said["blas"] = "scipy.linalg" in sys.modules
if len(sys.argv) > 1:
    from numba import njit, types
    from numba.extending import overload

    def given(x):
        raise NotImplementedError

    overload(given)(lambda x: lambda x: 3.0 * x)
    matrix = np.array([[2.0, 0.0], [0.0, 4.0]])
    said["others"] = [
        njit(lambda a: np.cov(a))(matrix).tolist(),
        njit(lambda a: np.linalg.solve(a, a))(matrix).tolist(),
        njit(lambda a: a @ a)(matrix).tolist(),
        njit(lambda x: given(x))(2.0),
    ]
print(json.dumps(said))
"""


def run(tmp_path, *more):
    path = tmp_path / "program.py"
    path.write_text(PROGRAM)
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    words = [sys.executable, str(path), *more]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def test_what_is_loaded_needs_one_refresh_and_no_blas(tmp_path):
    compiled, loaded = run(tmp_path), run(tmp_path)
    assert compiled["hits"] == [0, 0]
    assert compiled["refreshes"] > 0
    assert loaded == {"found": [3.0, 1.0, 3.0, 1.0], "hits": [2, 2], "refreshes": 0, "blas": False}


def test_code_of_others_has_its_declarations_and_blas(tmp_path):
    run(tmp_path)
    said = run(tmp_path, "others")
    assert said["hits"] == [2, 2]
    identity, squares = [[1.0, 0.0], [0.0, 1.0]], [[4.0, 0.0], [0.0, 16.0]]
    assert said["others"] == [[[2.0, -4.0], [-4.0, 8.0]], identity, squares, 6.0]
