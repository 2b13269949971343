"""A stream is warm when it starts: its first window loads little more."""

import subprocess
import sys

import numpy as np
import pytest

from floatref import pipelines, start_stream
from floatref.live import warming
from floatref.live.as_live import clocks_of
from floatref.live.starting import settle
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

NOT_WARMED = {
    "count_runs": "looks at a sensor that repeats a sample, which that of the drive does not",
    "multiply_inverse": "1-σ of a levelled stop, for the drive's body leans as no vehicle does",
}
FIRST_WINDOW = """
import sys
from floatref import start_stream
from floatref.kernels.compiling import Kernel
from floatref.live.as_live import clocks_of
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

def loaded():
    found = set()
    for module in list(sys.modules.values()):
        if getattr(module, "__name__", "").startswith("floatref."):
            for name, each in vars(module).items():
                if isinstance(each, Kernel):
                    found |= {(module.__name__, name, str(s)) for s in each.signatures}
    return found | {(name,) for name in sys.modules if name.startswith(("scipy", "numba"))}

drive = Scenario(manoeuvre="stop", event_at_m=900.0, length_m=2600.0, rate_hz=1000.0, seed=4)
recording = simulate(drive).recording
with start_stream(recording.setup, clocks_of(recording), sys.argv[1]) as stream:
    before = loaded()
    clocks = clocks_of(recording)
    stream.push({
        c.id: (c.times_s, c.values) if clocks[c.id] is None else c.values
        for c in recording.channels
    })
    points = stream.finish()
assert any(p.state == "final" and p.pipeline for p in points)
print(*sorted({each[-2] for each in loaded() - before if len(each) > 1}))
print(*sorted(each[0] for each in loaded() - before if len(each) == 1))
"""


@pytest.fixture(scope="module")
def recording():
    drive = Scenario(length_m=300.0, rate_hz=1000.0, response=True, seed=5)
    return simulate(drive).recording


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", pipelines())
def test_every_pipeline_takes_the_drive_and_is_stationary_in_it(recording, pipeline):
    order = settle(recording.setup, clocks_of(recording), pipeline)
    assert warming.drive(order, True) > 0
    distance = np.concatenate(
        [piece.values for each in warming.made_up(order.clocks) for n, piece in each.items()
         if n.name == "distance"]
    )  # fmt: skip
    stands = np.diff(distance) == 0.0
    assert 1.5 < np.count_nonzero(stands) / 1000.0 < 2.5


@pytest.mark.slow
@pytest.mark.parametrize(
    "pipeline",
    ["temporal-adaptive-hpf-spatial-backward", "road-prior-smoother", "kalman-smoother"],
)
def test_the_first_window_loads_no_library_and_two_kernels_at_most(pipeline):
    ran = subprocess.run(
        [sys.executable, "-c", FIRST_WINDOW, pipeline], capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stderr
    kernels, libraries = ran.stdout.split("\n")[:2]
    assert set(kernels.split()) <= NOT_WARMED.keys()
    assert not libraries


def test_a_process_warms_a_pipeline_once(drive, monkeypatch):
    recording = drive([(20.0, 5.0)])
    driven, known = [], set()
    monkeypatch.setattr("floatref.live.stream.warm", warming.warm)
    monkeypatch.setattr(warming, "drive", lambda order, provisional: driven.append(order))
    monkeypatch.setattr(warming, "_warmed", lambda: known)
    for pipeline in ("temporal-basic", "temporal-basic", "spatial-hpf"):
        start_stream(recording.setup, clocks_of(recording), pipeline).close()
    assert [order.pipelines for order in driven] == [("temporal-basic",), ("spatial-hpf",)]
