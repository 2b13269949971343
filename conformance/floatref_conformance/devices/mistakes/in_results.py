"""Profiles spoilt on their way out: shape, place, flags."""

from floatref_conformance.devices.mistakes import profiles as p
from floatref_conformance.devices.mistakes.drives import middle_m
from floatref_conformance.devices.mistakes.memory import Repeated
from floatref_conformance.devices.mistakes.mistake import Mistake, all_but

IN_RESULTS = (
    Mistake("all-zeros", "delivers a flat profile", all_but("low-speed"), after=p.scaled(0.0)),
    Mistake(
        "upside-down",
        "delivers the profile upside down",
        all_but("low-speed", "faults"),
        after=p.scaled(-1.0),
    ),
    Mistake("scaled", "delivers 0.8 of the profile", all_but("low-speed"), after=p.scaled(0.8)),
    Mistake("in-mm", "delivers mm for m", all_but("low-speed"), after=p.scaled(1000.0)),
    Mistake("in-feet", "delivers feet for m", all_but("low-speed"), after=p.scaled(1 / 0.3048)),
    Mistake(
        "over-smoothed",
        "averages the profile over 2 m",
        all_but("low-speed"),
        after=p.averaged(2.0),
    ),
    Mistake(
        "staircase",
        "holds each elevation for 0.5 m",
        all_but("low-speed", "throttle", "braking", "stop"),
        after=p.in_steps(0.5),
    ),
    Mistake(
        "coarse", "delivers whole millimetres", ("waveband", "invariance"), after=p.rounded(0.001)
    ),
    Mistake(
        "noisy-where-flat",
        "adds noise of 0.07 m/km to a flat profile",
        ("quiescent",),
        after=p.noisy_where_flat(0.00008),
    ),
    Mistake(
        "motion-where-flat",
        "lets 1 % of the body's motion into a flat profile",
        ("bounce",),
        after=p.moved_where_flat(0.01),
    ),
    Mistake(
        "displaced",
        "delivers every feature 0.3 m late",
        ("quiescent", "bounce", "waveband", "distance"),
        after=p.moved(0.3),
    ),
    Mistake(
        "stretched",
        "makes distances 0.3 % too long",
        ("quiescent", "bounce", "waveband", "distance", "invariance"),
        after=p.stretched(0.003),
    ),
    Mistake(
        "backwards",
        "delivers the last point first",
        all_but("low-speed", "faults"),
        after=p.backwards,
    ),
    Mistake(
        "swapped-tracks",
        "delivers left as right, right as left",
        all_but("low-speed", "invariance"),
        after=p.swapped,
    ),
    Mistake(
        "tracks-alike",
        "delivers the mean of all wheel paths in each",
        all_but("low-speed", "invariance"),
        after=p.alike,
    ),
    Mistake("previous-result", "delivers the profile before", all_but(), after=p.Previous()),
    Mistake(
        "repeated-result",
        "delivers the profile before when a recording begins like the one before",
        ("faults",),
        after=Repeated(),
    ),
    Mistake(
        "nan-at-the-end",
        "leaves out the last 120 m",
        all_but("low-speed", "waveband"),
        after=p.missing_at_the_end(120.0),
    ),
    Mistake("begins-late", "leaves out the first 5 m", all_but(), after=p.beginning_late(5.0)),
    Mistake(
        "vouches-always",
        "says of every point that it is valid",
        ("low-speed", "near-stop", "stop", "faults"),
        after=p.vouched,
    ),
    Mistake(
        "vouches-never",
        "says of no point that it is valid",
        (
            "constant-speed",
            "coasting",
            "throttle",
            "braking",
            "near-stop",
            "stop",
            "dead-start",
            "faults",
        ),
        after=p.flagged,
    ),
    Mistake(
        "middle-flagged",
        "flags 124 m in the middle of every run",
        ("constant-speed", "braking", "near-stop", "stop", "dead-start", "faults"),
        after=p.flagged_around(middle_m, 124.0),
    ),
    Mistake(
        "held-at-the-stop",
        "holds the elevation 20 m to either side of the slowest point, and vouches for it",
        all_but("dead-start", "distance"),
        after=p.held_at_the_slowest(20.0),
    ),
)
"""What is wrong with all that is delivered."""
