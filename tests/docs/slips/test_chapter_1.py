"""Slips in the print of chapter 1: the printed form fails, the mended one holds."""

import math

import pytest

from floatref_reference.chapter_2.section_2_3_1_kinematics import body_fixed_acceleration

G = 9.80665


def test_error_of_a_tilted_accelerometer_1_5() -> None:
    theta, a_x, a_z = 0.05, -3.0, 0.7
    sine, cosine = math.sin(theta), math.cos(theta)
    body = body_fixed_acceleration([a_x, 0.0, a_z], theta, 0.0)
    error = float(body[2]) - a_z
    assert a_x * sine + (a_z + G) * (cosine - 1) == pytest.approx(error, abs=1e-12)
    printed = a_x * sine + (a_x + G) * (cosine - 1)
    assert abs(printed - error) > 4e-3
    longitudinal = float(body[0]) - a_x
    assert abs(longitudinal - error) > 0.3
