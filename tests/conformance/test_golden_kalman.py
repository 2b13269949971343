"""The golden vector of the Kalman smoother, of which the readings of GNSS are no samples."""

from fractions import Fraction

import numpy as np

from floatref.estimators.kalman import KalmanSmoother, Noise, Plan
from floatref.estimators.kalman.inputs import GNSS, IMU, QUALITY
from floatref.values.block import Axis, Block, Event, Header
from floatref.values.channels import ChannelId
from floatref.values.recording import Setup, TrackSetup
from floatref_conformance import golden
from floatref_reference.chapter_5.section_5_3 import capture, trigger

ACCELERATION, HEIGHT = ChannelId("vertical_acceleration", "main"), ChannelId("height", "main")


def smoothed(s, i):
    rate, interval_m = s.pop("rate_hz"), s.pop("interval_m")
    arm = tuple(s.pop(f"arm_{axis}") for axis in "xyz")
    values = {ChannelId(name): i[name.removesuffix("_specific_force")] for name in IMU}
    values |= {HEIGHT: i["height"], ChannelId("distance"): i["distance"]}
    values[ACCELERATION] = i["vertical"] - 9.80665
    values[ChannelId("travel_speed")] = np.ones(i["height"].size)
    names = "gnss_height", "gnss_velocity", "gnss_pitch", "gnss_roll"
    readings = zip(i["gnss_at"], *(i[name] for name in names), strict=True)
    events = tuple(
        Event(at / rate, {QUALITY: 4.0, **dict(zip(GNSS, y, strict=True))}) for at, *y in readings
    )
    setup = Setup(gnss_antenna_offset_m=arm, tracks={"main": TrackSetup((0.0, 0.0, 0.0))})
    noise = Noise(**s, lean_rad=0.0, gnss_height_walk=0.0)
    stage = KalmanSmoother(Plan(reflects=False), noise, waiting_s=1e9)
    axes = Axis.TIME, 1 / rate, 0.0, Fraction(rate)
    stage.start(Header(*axes, frozenset(values), ("main",), setup))
    made = (stage.push(Block(0, values, events=events)), *stage.finish())
    (block,) = [block for block in made if len(block)]
    elevation = block[ChannelId("floating_reference_height", "main")] - i["height"]
    return np.array(capture(elevation, trigger(i["distance"], interval_m)))


def test_the_smoother_of_the_sdk_makes_of_its_vector_what_the_reference_makes():
    vector = golden.read("kalman-smoother")
    inputs = {key: np.array(x, dtype=float) for key, x in vector["inputs"].items()}
    expected = np.array(vector["outputs"]["elevation"])
    allowed = vector["tolerance"]["float64"] * np.abs(expected).max()
    made = smoothed(dict(vector["settings"]), inputs)
    np.testing.assert_allclose(made, expected, rtol=0, atol=allowed)
