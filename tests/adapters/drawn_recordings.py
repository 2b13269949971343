"""Recordings as hypothesis draws them: channels with drop-outs on clocks of either kind."""

import numpy as np
from hypothesis import strategies as st

from floatref import Channel, Recording, Setup, StampedClock, TrackSetup, UniformClock

NAMES = ("height", "vertical_specific_force", "distance", "gnss_height", "roll_rate", "pitch_rate")
finite = st.floats(allow_infinity=False, width=64)


@st.composite
def clocks(draw, count):
    start = draw(st.floats(-1e6, 1e6) | st.just(1.7e9))
    if draw(st.booleans()):
        return UniformClock.of(draw(st.floats(0.01, 1e5)), start)
    steps = draw(st.lists(st.floats(1e-3, 1e3), min_size=count, max_size=count))
    return StampedClock.of(start + np.cumsum(steps))


@st.composite
def recordings(draw):
    channels = []
    used = draw(st.lists(st.sampled_from(NAMES), min_size=1, max_size=6, unique=True))
    clock = None
    for name in used:
        if clock is None or draw(st.booleans()):
            count = draw(st.integers(1, 40))
            clock = draw(clocks(count))
        values = draw(st.lists(finite, min_size=count, max_size=count))
        track = draw(st.sampled_from([None, "left", "Ünder 2"]))
        channels.append(Channel.of(name, values, clock, track))
    setup = Setup(0.05, (1.0, 0.0, 2.0), {"left": TrackSetup((0.0, 1.0, 0.5))})
    return Recording(tuple(channels), setup, "maker", "model 7")
