"""Faults of gyros, horizontal accelerometers and GNSS receivers."""

from math import degrees

from floatref_conformance.faults import sample_faults as f
from floatref_conformance.faults.listed import ListedFault, clocked, part, whole
from floatref_conformance.faults.of_accelerometers import FOOT_M, G
from floatref_conformance.faults.placing import exchange, late

ROLL, PITCH, YAW = "roll_rate", "pitch_rate", "yaw_rate"
ALONG, ACROSS = "longitudinal_specific_force", "lateral_specific_force"
UP, RISING = "gnss_height", "gnss_vertical_velocity"
DEGREES = degrees(1.0)

INERTIAL_FAULTS = (
    *(whole(f"imu-{name.replace('_', '-')}-sign", name, "sign inverted", f.scale(-1.0))
      for name in (ROLL, PITCH, YAW)),
    *(whole(f"imu-{name.replace('_', '-')}-in-degrees", name, "in degrees per second",
            f.scale(DEGREES)) for name in (ROLL, PITCH)),
    whole("imu-pitch-rate-scale-0.5", PITCH, "scale 0.5", f.scale(0.5)),
    whole("imu-pitch-rate-stuck", PITCH, "stuck all the time", f.hold),
    part("imu-pitch-rate-stuck-2-s", PITCH, "stuck for 2 s", f.hold, 2.0),
    part("imu-pitch-rate-drop-out", PITCH, "no samples for 2 s", f.lose, 2.0),
    whole("imu-pitch-rate-noise-only", PITCH, "noise of 0.02 rad/s", f.be_noise(0.02)),
    whole("imu-pitch-rate-bias", PITCH, "0.02 rad/s added", f.add(0.02)),
    clocked("imu-pitch-rate-late", PITCH, "0.2 s late", late(0.2)),
    ListedFault("imu-rates-exchanged", "roll and pitch rate exchanged", True,
                exchange((ROLL, PITCH))),
    whole("imu-along-sign", ALONG, "sign inverted", f.scale(-1.0)),
    whole("imu-along-in-g", ALONG, "in g", f.scale(1 / G)),
    whole("imu-across-sign", ACROSS, "sign inverted", f.scale(-1.0)),
    whole("imu-along-scale-2", ALONG, "scale 2", f.scale(2.0)),
    whole("imu-along-stuck", ALONG, "stuck all the time", f.hold),
    clocked("imu-along-late", ALONG, "0.5 s late", late(0.5)),
    ListedFault("imu-forces-exchanged", "along and across exchanged, in each wheel path", True,
                exchange((f"left.{ALONG}", f"left.{ACROSS}"), (f"right.{ALONG}", f"right.{ACROSS}"))
                ),
)  # fmt: skip
SATELLITE_FAULTS = (
    whole("gnss-height-sign", UP, "sign inverted", f.scale(-1.0)),
    whole("gnss-height-in-feet", UP, "in feet", f.scale(1 / FOOT_M)),
    whole("gnss-height-in-mm", UP, "in mm", f.scale(1000.0)),
    whole("gnss-height-scale-2", UP, "scale 2", f.scale(2.0)),
    clocked("gnss-height-late-0.2-s", UP, "0.2 s late", late(0.2)),
    clocked("gnss-height-late-1-s", UP, "1 s late", late(1.0)),
    whole("gnss-height-stuck", UP, "stuck all the time", f.hold),
    part("gnss-height-stuck-2-s", UP, "stuck for 2 s", f.hold, 2.0),
    part("gnss-height-leap", UP, "0.5 m more from one place on", f.add(0.5), None),
    part("gnss-height-wanders", UP, "0.3 m off within 3 s", f.swell(0.3), 3.0),
    part("gnss-height-ramp", UP, "ramp to 1 m within 5 s", f.ramp(1.0), 5.0),
    whole("gnss-height-noise", UP, "noise of 0.1 m added", f.add_noise(0.1)),
    part("gnss-height-spikes", UP, "5 readings 1 m off", f.spikes(1.0, 5), 5.0),
    part("gnss-height-drop-out", UP, "no readings for 3 s", f.lose, 3.0),
    whole("gnss-velocity-sign", RISING, "sign inverted", f.scale(-1.0)),
    whole("gnss-velocity-in-feet", RISING, "in ft/s", f.scale(1 / FOOT_M)),
    clocked("gnss-velocity-late-0.5-s", RISING, "0.5 s late", late(0.5)),
    whole("gnss-velocity-stuck", RISING, "stuck all the time", f.hold),
    whole("gnss-pitch-sign", "gnss_pitch", "sign inverted", f.scale(-1.0)),
    whole("gnss-pitch-in-degrees", "gnss_pitch", "in degrees", f.scale(DEGREES)),
    whole("gnss-quality-lost", "gnss_quality", "single fixes only", f.constant(1.0)),
)  # fmt: skip
