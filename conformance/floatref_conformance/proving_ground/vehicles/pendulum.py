"""The inverted pendulum of section 2.3.2: a body that pitches while its trolley brakes.

(2.22): θ'' = (g/L)·sin θ − k/(mL²)·θ − c/(mL²)·θ' − (x''/L)·cos θ, nose down positive. The
road is flat. The profiler sits h_p above and l_p ahead of the rotation centre, at

    X = x + l_p·cos θ + h_p·sin θ,    Z = h_rc + h_p·cos θ − l_p·sin θ.

Their second derivatives along the body's axes are (2.23) and (2.24), which hold in print:
x''·cos θ + h_p·θ'' − l_p·θ'² and x''·sin θ − h_p·θ'² − l_p·θ''. They leave gravity out; an
accelerometer with 1 g removed reads −g·sin θ and g·(cos θ − 1) besides, as (2.17) has it.
"""

from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.proving_ground.drives.drive import Longitudinal, Motion


@dataclass(frozen=True)
class SinSquaredPulse:
    """A smooth brake: x'' = −peak·sin²(π(t − start)/duration) during the pulse, else 0.

    (2.26) prints a full sine, which leaves the speed as it was; this is the pulse that takes
    22 to 20 m/s at 0.4 g in 1 s, as figure 2.21 has it. The loss of speed is peak·duration/2.

    Attributes:
        initial_speed: in m/s.
        peak: largest deceleration, in m/s², positive.
        start_s: in s.
        duration_s: T in (2.26), in s.
    """

    initial_speed: float = 22.0
    peak: float = 0.4 * STANDARD_GRAVITY
    start_s: float = 2.0
    duration_s: float = 1.0

    def motion(self, times: FloatArray) -> Motion:
        """Return the motion at ``times`` in s, in closed form."""
        times = np.asarray(times, dtype=np.float64)
        t = np.clip(times - self.start_s, 0.0, self.duration_s)
        after = np.maximum(times - self.start_s - self.duration_s, 0.0)
        omega = 2 * np.pi / self.duration_s
        lost = self.peak / 2 * (t - np.sin(omega * t) / omega)
        behind = self.peak / 2 * (t**2 / 2 - (1 - np.cos(omega * t)) / omega**2) + lost * after
        return Motion(
            distance=self.initial_speed * times - behind,
            speed=self.initial_speed - lost,
            acceleration=-self.peak / 2 * (1 - np.cos(omega * t)),
        )


@dataclass(frozen=True)
class Pendulum:
    """A host vehicle as one rigid body on a rotational spring.

    The default is a van with the profiler on its front bumper. Without anti-dive it rotates
    about ground level, its arm is then the height of its centre of mass, and it dives by 2.6°
    per g. As (2.22) lumps the mass into one point, arm and dive fix its frequency, 2.5 Hz.

    Attributes:
        mass_kg: m, sprung.
        rotation_centre_m: h_rc, above the road.
        arm_m: L_cm, of the centre of mass above the rotation centre.
        stiffness: k_r, in N·m/rad.
        damping: c_r, in N·m·s/rad.
        profiler_up_m: h_p, above the rotation centre.
        profiler_forward_m: l_p, ahead of the rotation centre; negative behind it.
    """

    mass_kg: float = 2700.0
    rotation_centre_m: float = 0.0
    arm_m: float = 0.9
    stiffness: float = 550e3
    damping: float = 13.5e3
    profiler_up_m: float = 0.4
    profiler_forward_m: float = 2.2

    def __post_init__(self) -> None:
        """Refuse a body without mass or arm, and a spring too soft to hold it up."""
        if not (self.mass_kg > 0 and self.arm_m > 0 and self.damping >= 0):
            raise InputError(f"{self}: mass and arm must be above zero, damping not below it")
        if self.stiffness <= self.mass_kg * STANDARD_GRAVITY * self.arm_m:
            raise InputError(f"stiffness {self.stiffness} N·m/rad lets the pendulum fall over")

    @property
    def inertia(self) -> float:
        """mL² in kg·m²."""
        return self.mass_kg * self.arm_m**2

    @property
    def natural_frequency_hz(self) -> float:
        """Undamped frequency of small pitch motion, in Hz."""
        square = self.stiffness / self.inertia - STANDARD_GRAVITY / self.arm_m
        return float(np.sqrt(square) / (2 * np.pi))

    @property
    def pitch_gain(self) -> float:
        """Steady pitch per deceleration for small angles, in rad per g."""
        tilting = self.mass_kg * STANDARD_GRAVITY * self.arm_m
        return tilting / (self.stiffness - tilting)

    def pitch_acceleration(self, pitch: float, rate: float, acceleration: float) -> float:
        """Return θ'' of (2.22) in rad/s² for x'' = ``acceleration`` in m/s²."""
        restoring = (self.stiffness * pitch + self.damping * rate) / self.inertia
        driving = STANDARD_GRAVITY * np.sin(pitch) - acceleration * np.cos(pitch)
        return float(driving / self.arm_m - restoring)


@dataclass(frozen=True, eq=False)
class PendulumMotion:
    """What the sensors on the pendulum measure, and the truth; all arrays of shape (n,).

    Attributes:
        time: in s.
        trolley: its longitudinal motion.
        pitch: θ in rad, nose down positive.
        pitch_rate: θ' in rad/s.
        pitch_acceleration: θ'' in rad/s².
        body_longitudinal: a_xp^b of (2.23) in m/s², along the body.
        body_vertical: a_zp^b of (2.24) in m/s², along the body, 1 g removed.
        body_height: h^b of (2.25) in m, range along the body.
        longitudinal: a_xp^w in m/s², level.
        vertical: a_zp^w in m/s², plumb: what the floating reference needs.
        height: h^w in m, plumb range, which is the profiler's true height here.
    """

    time: FloatArray
    trolley: Motion
    pitch: FloatArray
    pitch_rate: FloatArray
    pitch_acceleration: FloatArray
    body_longitudinal: FloatArray
    body_vertical: FloatArray
    body_height: FloatArray
    longitudinal: FloatArray
    vertical: FloatArray
    height: FloatArray


def simulate_pendulum(
    pendulum: Pendulum, trolley: Longitudinal, duration_s: float, rate_hz: float = 1000.0
) -> PendulumMotion:
    """Integrate (2.22) by the classical Runge-Kutta scheme, starting upright and at rest.

    InputError for a duration or a rate that is not above zero.
    """
    if not (duration_s > 0 and rate_hz > 0):
        raise InputError(f"duration {duration_s} s and rate {rate_hz} Hz must be above zero")
    count = round(duration_s * rate_hz) + 1
    half_steps = trolley.motion(np.arange(2 * count - 1) / (2 * rate_hz)).acceleration
    pitch, rate = _pitch(pendulum, half_steps, 1 / rate_hz)
    time = np.arange(count) / rate_hz
    return _measure(pendulum, time, trolley.motion(time), pitch, rate)


def _pitch(
    pendulum: Pendulum, half_steps: FloatArray, step_s: float
) -> tuple[FloatArray, FloatArray]:
    """Return θ and θ' at every other value of x'', which is given twice per step."""
    count = (half_steps.size + 1) // 2
    states = np.zeros((count, 2))
    for k in range(count - 1):
        first, middle, last = half_steps[2 * k : 2 * k + 3]
        states[k + 1] = _runge_kutta(pendulum, states[k], first, middle, last, step_s)
    return states[:, 0], states[:, 1]


def _runge_kutta(
    pendulum: Pendulum, state: FloatArray, first: float, middle: float, last: float, step_s: float
) -> FloatArray:
    def slope(at: FloatArray, acceleration: float) -> FloatArray:
        return np.array([at[1], pendulum.pitch_acceleration(at[0], at[1], acceleration)])

    k1 = slope(state, first)
    k2 = slope(state + step_s / 2 * k1, middle)
    k3 = slope(state + step_s / 2 * k2, middle)
    k4 = slope(state + step_s * k3, last)
    return state + step_s / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def _measure(
    pendulum: Pendulum, time: FloatArray, trolley: Motion, pitch: FloatArray, rate: FloatArray
) -> PendulumMotion:
    """Return (2.23) to (2.25) with gravity as in (2.17), and the truth behind them."""
    up, forward = pendulum.profiler_up_m, pendulum.profiler_forward_m
    s, c = np.sin(pitch), np.cos(pitch)
    bent = np.array(
        [
            pendulum.pitch_acceleration(*row)
            for row in zip(pitch, rate, trolley.acceleration, strict=True)
        ]
    )
    along = trolley.acceleration * c + up * bent - forward * rate**2
    upward = trolley.acceleration * s - up * rate**2 - forward * bent
    height = pendulum.rotation_centre_m + up * c - forward * s
    return PendulumMotion(
        time,
        trolley,
        pitch,
        rate,
        bent,
        body_longitudinal=along - STANDARD_GRAVITY * s,
        body_vertical=upward + STANDARD_GRAVITY * (c - 1),
        body_height=height / c,
        longitudinal=along * c + upward * s,
        vertical=upward * c - along * s,
        height=height,
    )
