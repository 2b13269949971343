"""What encoders of 1 kHz read at steady speed, and what of it does not measure travel."""

import numpy as np
from hypothesis import HealthCheck, settings

from floatref.screening.damage.encoder_damage import encoder_damage
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

RATE, COUNT = 1000.0, 20_000
CLOCK = UniformClock.of(RATE)
laws = settings(
    deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def travel(speed=20.0, count_m=0.0003, rate=RATE):
    return count_m * np.floor(speed * np.arange(COUNT) / rate / count_m)


def damage(values, clock=CLOCK):
    return encoder_damage(Channel.of("distance", values, clock))
