"""Units of the fields of NovAtel logs, and the quality of their kinds of solution.

The receivers' list of logs has no units. They are given for the logs whose manual says them; a
field of any other log has no unit, and the channel map says it.
"""

from dataclasses import dataclass

POSITIONS: tuple[str, ...] = (
    "BESTPOS",
    "PSRPOS",
    "RTKPOS",
    "PPPPOS",
    "BESTGNSSPOS",
    "MATCHEDPOS",
    "MARKPOS",
)
POSITIONS += ("MARK2POS", "MARK3POS", "MARK4POS", "BESTUTM", "MASTERPOS", "ROVERPOS")
VELOCITIES = ("BESTVEL", "PSRVEL", "RTKVEL", "PPPVEL", "BESTGNSSVEL")
INERTIAL: tuple[str, ...] = (
    "INSPVA",
    "INSPVAX",
    "INSPOS",
    "INSPOSX",
    "INSVEL",
    "INSVELX",
    "INSATT",
    "INSATTX",
)
INERTIAL += ("INSSTDEV", "INSSPD", "IMURATEPVA", *(f"MARK{k}PVA" for k in range(1, 5)))
BASELINES = ("HEADING", "HEADING2", "DUALANTENNAHEADING")
RATES = ("CORRIMUDATA", "CORRIMU", "RAWIMU", "RAWIMUX")
KNOWN = frozenset((*POSITIONS, *VELOCITIES, *BASELINES))
KNOWN |= frozenset((*INERTIAL, *(f"{name}S" for name in INERTIAL)))
TIMED = KNOWN | frozenset((*RATES, *(f"{name}S" for name in RATES), "RAWIMUSX", "TIME"))

DEGREES: tuple[str, ...] = (
    "latitude",
    "longitude",
    "roll",
    "pitch",
    "azimuth",
    "heading",
    "ground_track",
)
DEGREES += tuple(f"{name}_std_dev" for name in ("roll", "pitch", "azimuth", "heading"))
METRES: tuple[str, ...] = (
    "height",
    "orthometric_height",
    "undulation",
    "northing",
    "easting",
    "b_length",
)
METRES += tuple(f"{name}_std_dev" for name in ("latitude", "longitude", "height"))
SPEEDS: tuple[str, ...] = ("north_vel", "east_vel", "up_vel", "horizontal_speed")
SPEEDS += tuple(f"{name}_vel_std_dev" for name in ("north", "east", "up"))
SECONDS = ("latency", "diff_age", "solution_age")
UNITS = {
    **dict.fromkeys(DEGREES, "deg"),
    **dict.fromkeys(METRES, "m"),
    **dict.fromkeys(SPEEDS, "m/s"),
    **dict.fromkeys(SECONDS, "s"),
}
TURN = "turn since the log before, rad"
GAIN = "velocity gained since the log before, m/s, without gravity"
PER_LOG = {
    "corr_wb_ib": TURN,
    "pitch": f"{TURN}, nose up positive",
    "roll": f"{TURN}, left side up positive",
    "azimuth": f"{TURN}, left turn positive",
    "corr_fb": GAIN,
    "lateral": f"{GAIN}, to the right",
    "longitudinal": f"{GAIN}, forward",
    "vertical": f"{GAIN}, up",
}
NOTES = {
    "orthometric_height": "above mean sea level",
    "undulation": "geoid above the ellipsoid",
    "pitch": "nose up positive",
    "roll": "left side up positive",
    "latency": "by how much a velocity is older than its time stamp",
}


@dataclass(frozen=True)
class Unit:
    """The unit of a field, "" if it has no unit or an unknown one, and a note on it."""

    text: str
    note: str


def find_unit(log: str, field: str) -> Unit:
    """Return the unit of the field of a log."""
    if log in VELOCITIES and field == "z":
        return Unit("m/s", "up")
    if log in TIMED and field in ("seconds", "gps_seconds"):
        return Unit("s", "of the GPS week")
    if log.startswith("CORRIMU"):
        return Unit("", PER_LOG.get(field, ""))
    if log not in KNOWN:
        return Unit("", "")
    if log in BASELINES and field == "pitch":
        return Unit("deg", "of the base line, up to the second antenna positive")
    if field == "height":
        return Unit(
            "m", "above the ellipsoid" if log in INERTIAL_HEIGHT else "above mean sea level"
        )
    return Unit(UNITS.get(field, ""), NOTES.get(field, ""))


INERTIAL_HEIGHT: tuple[str, ...] = (
    "INSPVA",
    "INSPVAS",
    "INSPOS",
    "INSPOSS",
    "IMURATEPVA",
    "IMURATEPVAS",
)
INERTIAL_HEIGHT += tuple(f"MARK{k}PVA" for k in range(1, 5))
SOLVED = frozenset(("SOL_COMPUTED", "INS_HIGH_VARIANCE", "INS_SOLUTION_GOOD", "INS_SOLUTION_FREE"))
SOLVED |= {"INS_ALIGNMENT_COMPLETE", "INS_TEST_SOLUTION_GOOD"}
"""Status of a solution, of the receiver or of its inertial unit, that is one."""

QUALITIES = {
    **dict.fromkeys(("NONE",), 0.0),
    **dict.fromkeys(("SINGLE", "DOPPLER_VELOCITY", "INS_PSRSP", "INS"), 1.0),
    **dict.fromkeys(("PPP_BASIC_CONVERGING", "INS_PPP_BASIC_CONVERGING"), 1.0),
    **dict.fromkeys(("PSRDIFF", "WAAS", "SBAS", "OMNISTAR", "CDGPS"), 2.0),
    **dict.fromkeys(("INS_PSRDIFF", "INS_SBAS", "INS_WAAS", "INS_OMNISTAR"), 2.0),
    **dict.fromkeys(("PPP_CONVERGING", "INS_PPP_CONVERGING", "PPP_BASIC", "INS_PPP_BASIC"), 2.0),
    **dict.fromkeys(("L1_INT", "WIDE_INT", "NARROW_INT"), 4.0),
    **dict.fromkeys(("RTK_DIRECT_INS", "INS_RTKFIXED"), 4.0),
    **dict.fromkeys(("L1_FLOAT", "IONOFREE_FLOAT", "NARROW_FLOAT", "INS_RTKFLOAT"), 5.0),
    **dict.fromkeys(("OMNISTAR_HP", "OMNISTAR_XP", "PPP", "INS_PPP"), 5.0),
    **dict.fromkeys(("PPP_PLUS", "INS_PPP_PLUS"), 5.0),
    **dict.fromkeys(("INS_OMNISTAR_HP", "INS_OMNISTAR_XP"), 5.0),
    **dict.fromkeys(("PROPAGATED",), 6.0),
    **dict.fromkeys(("FIXEDPOS", "FIXEDHEIGHT"), 7.0),
}
"""Of GGA, by the kind of solution; a kind that is not here has no quality."""
