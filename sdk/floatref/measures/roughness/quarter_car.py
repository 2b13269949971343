"""The quarter car: its frequency response and its exact transition over one interval.

K1 = k_t/m_s, K2 = k_s/m_s, C = c_s/m_s and μ = m_u/m_s are the tyre and suspension constants
per sprung mass m_s (Karamihas 2021, figure 2.1). Input is profile slope, output the suspension
stroke per distance, z_s' − z_u', both in m/m.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from floatref.values.arrays import FloatArray

KMH = 1000.0 / 3600.0
"""One km/h in m/s."""


class Mode(NamedTuple):
    """Pole and input gain of one mode, real and imaginary parts."""

    pole_re: float
    pole_im: float
    gain_re: float
    gain_im: float


Modes = tuple[Mode, Mode]


@dataclass(frozen=True)
class QuarterCar:
    """Constants of a quarter car: K1 and K2 in 1/s², C in 1/s, μ without unit."""

    tyre_stiffness: float
    suspension_stiffness: float
    damping: float
    mass_ratio: float

    def stroke_response(self, angular_frequency: FloatArray) -> np.ndarray:
        """Return H_GCSS(ω), complex, ω in rad/s (2.9), (2.10).

        The damping term of (2.10) is jCω(K1 − ω²(1 + μ)); the print has + for its −.
        """
        k1, k2, c, mu = self._constants()
        w2 = np.square(angular_frequency)
        stiff = mu * w2 * w2 - (k1 + k2 * (1 + mu)) * w2 + k1 * k2
        damped = c * angular_frequency * (k1 - w2 * (1 + mu))
        return np.asarray(k1 * w2 / (stiff + 1j * damped))

    def modes(self, step_s: float, scale: float = 1.0) -> Modes:
        """Return pole and input gain of both modes for a slope held over ``step_s`` seconds.

        With eigenvalue λ and residue r of the transfer function the pole is exp(λΔt) and the
        gain 2r(exp(λΔt) − 1)/λ, times ``scale``; the output is the sum of the modes' real parts.
        Needs an underdamped car, as the Golden Car is.
        """
        poles, residues = self._poles_and_residues()
        gains = 2.0 * scale * residues * np.expm1(poles * step_s) / poles
        steps = np.exp(poles * step_s)
        rows = np.stack([steps.real, steps.imag, gains.real, gains.imag], axis=1).tolist()
        return Mode(*rows[0]), Mode(*rows[1])

    def _poles_and_residues(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the poles with positive imaginary part and their residues, (2,) each."""
        k1, k2, c, mu = self._constants()
        system = np.array(
            [
                [0.0, 1.0, 0.0, 0.0],
                [-k2, -c, k2, c],
                [0.0, 0.0, 0.0, 1.0],
                [k2 / mu, c / mu, -(k1 + k2) / mu, -c / mu],
            ]
        )
        poles, vectors = np.linalg.eig(system)
        input_gain = np.linalg.solve(vectors, np.array([0.0, 0.0, 0.0, k1 / mu]))
        residues = (vectors[0] - vectors[2]) * input_gain
        upper = poles.imag > 0
        return poles[upper], residues[upper]

    def _constants(self) -> tuple[float, float, float, float]:
        """Return K1, K2, C, μ."""
        return self.tyre_stiffness, self.suspension_stiffness, self.damping, self.mass_ratio


GOLDEN_CAR = QuarterCar(653.0, 63.3, 6.0, 0.15)
"""The vehicle of the IRI."""

RIDE_NUMBER_CAR = QuarterCar(5120.0, 390.0, 17.0, 0.036)
"""The vehicle of the Ride Number, from which the rows PTRN of Tables 2.5 and 2.6 follow."""


def moving_average_response(wave_number: FloatArray, base_m: float) -> FloatArray:
    """Return H_MA at ``wave_number`` in cycles/m for base length ``base_m`` in m (2.7)."""
    return np.asarray(np.sinc(base_m * wave_number))
