"""How large each sensor's errors are, and how often each sensor speaks.

Defaults follow Karamihas 2021, section 4.3 and Table 6.1. A noise density is two-sided: white
noise of density S sampled at f has the standard deviation S·√f, so that results do not depend
on the rate. 6·10⁻⁴ g of a 16-kHz accelerometer sample and 0.0077 °/s of a 100-Hz gyro sample
(Table 6.1) map to the densities below; the walks of that table have ambiguous units, so the
gyros' is K_A of (6.55) and the accelerometers' 1 µg after one second: with much more, the mean
of the 400-s run at 5 km/h could not be removed as Table 5.4 shows it. The accelerometers' bias
is near the 1.15 mg of section 5.3; their axes are level to within 0.25 to 0.75 degrees, as drawn.
Rate and resolution of the laser are those of the line lasers of section 4.3, for a point laser too.

A wheel carrier bears tens of g of impacts, and so a sensor of ±50 g that is made for them: a
micromachined one, with twice the bias and ten times the noise density of the accelerometers on
the body. The suspension's travel is read by a potentiometer or a level sensor of a few tenths
of a millimetre. These are our round numbers; no paper states its own.

A second source of distance: speed of GNSS at 20 Hz to 0.03 m/s RMS and an optical fifth wheel that
counts 2 mm are those of section 4.3. A receiver's Doppler speed is the mean of the interval before
it, and so half an interval late (NovAtel's BESTVEL states it as its latency). The bus is SAE J1939:
wheel-based vehicle speed (SPN 84) every 100 ms in steps of 1/256 km/h. Ours, without a source:
wheels of both sides slip and grow alike within 10 %; the bus takes a fixed tyre radius, and a tread
of 8 mm worn to 1.6 mm takes 1.9 % off 340 mm, so 1 % to either side; its speed is the mean of
its cycle, and 0 below 2 km/h (makers of passive wheel sensors give 2 mph as their least speed);
the optical wheel is right within 0.1 %, and its noise walks by 1 mm over 1 m.
"""

from dataclasses import dataclass, replace
from math import radians

from floatref.values.channels import STANDARD_GRAVITY

RATES = frozenset(
    {"range_rate_hz", "gyro_rate_hz", "gnss_rate_hz", "response_rate_hz", "bus_rate_hz"}
)
UNSCALED = RATES | {"gnss_drift_s", "idle_hz", "revving_hz_per_mps", "range_latency_s"}
"""Fields that are rates and times, not errors."""


@dataclass(frozen=True)
class SensorSuite:
    """The errors of all sensors; zero of an error is a perfect sensor.

    Attributes:
        force_noise: accelerometers, in m/s²/√Hz.
        force_bias: their bias in m/s²; a run draws 0.5 to 1.5 times it, of either sign.
        force_walk: random walk of the bias, in m/s²/√s.
        force_resolution: in m/s² (4 g in 16 bits; the paper's 12-bit converter had 1.08 mg).
        force_scale: scale error, relative; a run draws up to it, of either sign.
        misalignment_rad: tilt of the vertical accelerometers' axis; drawn as the bias is.
        vibration: of the accelerometers' mount by the engine, amplitude in m/s².
        idle_hz: the engine's speed at standstill (820 rpm).
        revving_hz_per_mps: its rise with speed, in Hz per m/s.
        range_noise_m: of a laser sample, in m.
        range_resolution_m: in m.
        range_scale: scale error, relative; drawn as the accelerometers' is.
        range_rate_hz: of the laser; samples are held in between. 0: as the accelerometers'.
        range_latency_s: age of a laser sample when it is recorded, in s.
        encoder_step_m: travel per count, in m.
        encoder_scale: scale error, relative; drawn up to it.
        encoder_error: scale error beside the one that is drawn, relative.
        slip_per_g: relative error of the encoder's speed per g of longitudinal acceleration. 0.025
            is fitted to two cells in print (`table.passes.FITTED`). 0.03 to 0.06 lose the 0.6 to
            1.2 m of a brake from 72 km/h (3.3.1.3), 0.12 the 0.8 m from 48 to 24 km/h (3.3.9).
            In a coast 0.12 moves the end of the section by 1.3 of print's "up to 2 m" (3.3.1.2);
            what is left would be the tyre's temperature.
        radius_growth: relative growth of the wheel's rolling radius from 16 to 97 km/h; up to 1 %
            in sections 3.3.1.1 and 3.3.9.
        radius_warming: its relative growth as the tyre warms up.
        wheel_spread: of slip and growth between the wheels of both sides, relative; drawn up to it.
        optical_step_m: travel per count of the optical wheel, in m.
        optical_scale: its scale error, relative; drawn up to it.
        optical_walk: random walk of its distance, in m/√m.
        bus_rate_hz: of the speed on the vehicle bus.
        bus_resolution: in m/s.
        bus_scale: its scale error, relative; drawn up to it.
        bus_delay_s: age of that speed when it is sent, in s.
        bus_silent_mps: below this speed in m/s the bus gives 0.
        gyro_noise: in rad/s/√Hz.
        gyro_bias: in rad/s; drawn as the accelerometers' is.
        gyro_walk: in rad/s/√s.
        gyro_rate_hz: of the gyros' own clock.
        gnss_rate_hz: of the receiver's own clock.
        gnss_drift_s: time constant of the correlated drifts.
        gnss_height_noise_m, gnss_height_drift_m: standard deviations, in m.
        gnss_velocity_noise: of every component, in m/s.
        gnss_speed_latency_s: age of the receiver's speed over ground, in s.
        gnss_pitch_noise, gnss_pitch_drift, gnss_roll_noise, gnss_roll_drift: in rad.
        gnss_position_drift_m: of latitude and longitude, in m.
        response_rate_hz: of the response channels' own clock.
        carrier_noise: accelerometers on wheel carriers, in m/s²/√Hz.
        carrier_bias: their bias in m/s²; drawn as the other accelerometers' is.
        carrier_walk: random walk of that bias, in m/s²/√s.
        carrier_resolution: in m/s² (±50 g in 16 bits).
        carrier_windup: tilt of the carrier by its brake, nose down, in rad per g of braking.
        deflection_noise_m: of a sample of the suspension's travel, in m.
        deflection_resolution_m: in m.
        deflection_scale: scale error, relative; a run draws up to it, of either sign.
        rig_height_noise_m, rig_velocity_noise, rig_angle_noise, rig_turn_noise: standard
            deviations of a test rig's heights in m, their rates in m/s, angles in rad and their
            second derivatives in rad/s².
        vehicle_error: of each parameter in ``setup.vehicle``, relative; drawn up to it.
    """

    force_noise: float = 6e-4 * STANDARD_GRAVITY / 16000**0.5
    force_bias: float = 1e-3 * STANDARD_GRAVITY
    force_walk: float = 1e-6 * STANDARD_GRAVITY
    force_resolution: float = 4 * STANDARD_GRAVITY / 2**16
    force_scale: float = 5e-4
    misalignment_rad: float = radians(0.5)
    vibration: float = 0.015
    idle_hz: float = 820 / 60
    revving_hz_per_mps: float = 1.0
    range_noise_m: float = 0.03e-3
    range_resolution_m: float = 0.004e-3
    range_scale: float = 5e-4
    range_rate_hz: float = 3240.0
    range_latency_s: float = 0.0
    encoder_step_m: float = 0.3e-3
    encoder_scale: float = 3e-4
    encoder_error: float = 0.0
    slip_per_g: float = 2.5e-2
    radius_growth: float = 0.0
    radius_warming: float = 0.0
    wheel_spread: float = 0.1
    optical_step_m: float = 2e-3
    optical_scale: float = 1e-3
    optical_walk: float = 1e-3
    bus_rate_hz: float = 10.0
    bus_resolution: float = 1 / 256 / 3.6
    bus_scale: float = 0.01
    bus_delay_s: float = 0.05
    bus_silent_mps: float = 2 / 3.6
    gyro_noise: float = radians(7.7e-3) / 100**0.5
    gyro_bias: float = radians(0.01)
    gyro_walk: float = radians(1.38e-6)
    gyro_rate_hz: float = 100.0
    gnss_rate_hz: float = 20.0
    gnss_drift_s: float = 60.0
    gnss_height_noise_m: float = 4e-3
    gnss_height_drift_m: float = 0.011
    gnss_velocity_noise: float = 0.03
    gnss_speed_latency_s: float = 0.025
    gnss_pitch_noise: float = radians(0.06)
    gnss_pitch_drift: float = radians(0.1)
    gnss_roll_noise: float = radians(0.1)
    gnss_roll_drift: float = radians(0.17)
    gnss_position_drift_m: float = 0.01
    response_rate_hz: float = 1000.0
    carrier_noise: float = 6e-3 * STANDARD_GRAVITY / 16000**0.5
    carrier_bias: float = 2e-3 * STANDARD_GRAVITY
    carrier_walk: float = 2e-6 * STANDARD_GRAVITY
    carrier_resolution: float = 100 * STANDARD_GRAVITY / 2**16
    carrier_windup: float = radians(1.0)
    deflection_noise_m: float = 0.1e-3
    deflection_resolution_m: float = 0.05e-3
    deflection_scale: float = 5e-3
    rig_height_noise_m: float = 0.05e-3
    rig_velocity_noise: float = 1e-3
    rig_angle_noise: float = 1e-5
    rig_turn_noise: float = 2e-3
    vehicle_error: float = 0.03

    @classmethod
    def ideal(cls) -> "SensorSuite":
        """Return the suite without any error, its range as fast as its accelerometers."""
        return replace(cls().scale(0.0), range_rate_hz=0.0)

    def scale(self, factor: float) -> "SensorSuite":
        """Return the suite with every error ``factor`` times as large, at the same rates."""
        larger = {
            name: factor * value for name, value in vars(self).items() if name not in UNSCALED
        }
        return replace(self, **larger)

    def idling(self) -> "SensorSuite":
        """Return the suite of a parked vehicle whose encoder is a signal generator."""
        return replace(
            self,
            revving_hz_per_mps=0.0,
            encoder_scale=0.0,
            slip_per_g=0.0,
            radius_growth=0.0,
            radius_warming=0.0,
        )
