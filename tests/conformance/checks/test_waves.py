"""Laws of the fit of waves: what was put in comes out."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.checks.waves import waves_of
from floatref_conformance.proving_ground.sines import WAVELENGTHS_M

seeds = st.integers(0, 2**32 - 1)


@settings(deadline=None, max_examples=10)
@given(seed=seeds, level=st.floats(-1, 1), slope=st.floats(-0.05, 0.05))
def test_waves_beside_any_line_are_found(seed: int, level: float, slope: float) -> None:
    rng = np.random.default_rng(seed)
    x = np.sort(rng.uniform(100.0, 374.32, 4000))
    put_in = rng.normal(size=WAVELENGTHS_M.size) + 1j * rng.normal(size=WAVELENGTHS_M.size)
    z = level + slope * x
    for amplitude, wavelength in zip(put_in, WAVELENGTHS_M, strict=True):
        z = z + (amplitude * np.exp(2j * np.pi * x / wavelength)).real
    assert waves_of(x, z, WAVELENGTHS_M) == pytest.approx(put_in, abs=1e-8)
