"""The stages that the response pipelines put at the points of their signal flow."""

from collections.abc import Iterator, Sequence

from floatref.builtin_pipelines.chapter_5 import ADAPTIVE
from floatref.interfaces.pipeline import Answer, Context, Pipeline
from floatref.stages.conditioning import Drop, RemoveGravity
from floatref.stages.filters.schedule import AdaptiveCutOff, ScheduleCutOff, ScheduleWaveNumber
from floatref.stages.filters.varying import (
    VaryingHighPassB3,
    VaryingHighPassB3R,
    VaryingHighPassB3S1,
    VaryingHighPassB3S2,
)
from floatref.stages.integration import Integrate
from floatref.stages.marks import MarkDrive
from floatref.stages.protocol import Stage
from floatref.stages.resampling import ToDistance
from floatref.stages.signals import CUTOFF, TRAVEL_SPEED
from floatref.stages.speed import TravelSpeed
from floatref.values.channels import ChannelId
from floatref.values.recording import TrackSetup
from floatref.vehicle_response.needs import (
    DEFLECTION,
    FORCE,
    Motion,
    has_deflection,
    is_there,
    motions,
    short,
    vehicle_model,
)
from floatref.vehicle_response.readings import calculation_rate_of, groups_of
from floatref.vehicle_response.stages import (
    CompareTravel,
    Denoise,
    EstimateRoad,
    JoinTyres,
    RestoreContact,
    ShiftAlong,
    ToRate,
)
from floatref.vehicle_response.stages.estimators import Group
from floatref.vehicle_response.stages.joining import elevation_under, sigma_under


def condition(context: Context) -> Sequence[Stage]:
    """Remove 1 g from every accelerometer, mark the drive, add speed and cut-off (5.7)."""
    found = [m for m in _motions(context) if m.acceleration and not m.angular]
    gravity = [RemoveGravity(m.force_name, m.acceleration_name) for m in found]
    wheel = next(m.acceleration_name for m in found if m.force_name == FORCE)
    transition = context.setting("transition_speed_mps")
    slow = max(
        context.setting("slow_mps"), transition + 4.0 / context.setting("transition_steepness")
    )
    marks = MarkDrive(slow, context.setting("stopping_time_s"), wheel)
    return (*gravity, marks, TravelSpeed(), ScheduleCutOff(_schedule(context)))


def first_integration(context: Context) -> Sequence[Stage]:
    """HPF_B3S1 of (5.7) on accelerations, and the integral of those that give a displacement."""
    return [stage for motion in _motions(context) for stage in _first(motion)]


def second_integration(context: Context) -> Sequence[Stage]:
    """HPF_B3S2 of (5.7), and the integral; measured displacements pass both filter stages, too.

    Accelerations pass them, too: then all signals of a linear model come from the same high-passed
    road, and the errors of bias and tilt below the cut-off are not taken for a force on a tyre.
    """
    stages = [stage for motion in _motions(context) for stage in _second(motion)]
    if _uses_deflection(context):
        stages.append(VaryingHighPassB3(DEFLECTION))
    return stages


def estimate_jointly(context: Context) -> Sequence[Stage]:
    """The joint input-state filter, steps (a) to (c) of Zhu, at the rate that follows the speed."""
    from floatref.builtin_pipelines.response_estimators import joint_filter

    return _estimate(context, groups_of(context, joint_filter))


def estimate_observing(context: Context) -> Sequence[Stage]:
    """The observer with unknown inputs, (8) to (15) of Imine, at that rate."""
    from floatref.builtin_pipelines.response_estimators import observer

    return _estimate(context, groups_of(context, observer))


def project(context: Context) -> Sequence[Stage]:
    """Decimate by encoder distance (5.3)."""
    return (ToDistance(context.setting("interval_m"), context.ends_m[0]),)


def finish(context: Context) -> Sequence[Stage]:
    """The backward stages (5.7), the shift from wheel to laser, and a track's tyres combined.

    What the tyres smooth over their contact is restored as far as possible.
    """
    tyres = _tyres(context)
    most = max(len(places) for places in tyres.values())
    setup, vehicle = context.header.setup, context.header.setup.vehicle
    ahead = 0.0 if vehicle is None else vehicle.x_m
    shifts = {}
    for track, places in tyres.items():
        sensors = setup.tracks.get(track, TrackSetup())
        laser = sensors.reference_point_m[0] + sensors.laser_offset_m[0]
        for k, x_m in enumerate(places):
            for name in (elevation_under(k), sigma_under(k)):
                shifts[ChannelId(name, track)] = ahead + x_m - laser
    backward = [VaryingHighPassB3R(elevation_under(k)) for k in range(most)]
    numbers = {track: range(len(places)) for track, places in tyres.items()}
    schedule = ScheduleWaveNumber(_schedule(context)), Drop(TRAVEL_SPEED)
    restored = RestoreContact(short(context, "contact_m"))
    return (*schedule, *backward, Drop(CUTOFF), ShiftAlong(shifts), JoinTyres(numbers), restored)


def _motions(context: Context) -> tuple[Motion, ...]:
    return motions(context.header, vehicle_model(context.header.setup))


def _uses_deflection(context: Context) -> bool:
    model = vehicle_model(context.header.setup)
    return has_deflection(model) and is_there(context.header, DEFLECTION)


def _schedule(context: Context) -> AdaptiveCutOff:
    return AdaptiveCutOff(
        context.setting("low_speed_cutoff_hz"),
        context.setting("cutoff_wavelength_m"),
        context.setting("transition_speed_mps"),
        context.setting("transition_steepness"),
    )


def _first(motion: Motion) -> Iterator[Stage]:
    if motion.acceleration:
        yield VaryingHighPassB3S1(motion.acceleration_name)
    if motion.integrated_twice:
        yield Integrate(motion.acceleration_name, motion.integral_name, keeps_source=True)
    if motion.integrated_once:
        yield VaryingHighPassB3S1(motion.velocity_name)


def _second(motion: Motion) -> Iterator[Stage]:
    if motion.acceleration:
        yield VaryingHighPassB3S2(motion.acceleration_name)
    if motion.integrated_twice:
        yield VaryingHighPassB3S2(motion.integral_name)
        yield Integrate(motion.integral_name, motion.displacement_name)
    if motion.integrated_once:
        yield VaryingHighPassB3S2(motion.velocity_name)
        yield Integrate(motion.velocity_name, motion.displacement_name, keeps_source=True)
    elif motion.velocity:
        yield VaryingHighPassB3(motion.velocity_name)
    if motion.displacement:
        yield VaryingHighPassB3(motion.displacement_name)


def _estimate(context: Context, groups: Sequence[Group]) -> Sequence[Stage]:
    stages: list[Stage] = [ToRate(calculation_rate_of(context), context.ends_m[1])]
    stages += _watch(context)
    components = context.settings.get("denoise_components")
    if components:
        names = dict.fromkeys(c.name for group in groups for c in group.channels)
        window_s = short(context, "denoise_window_s")
        stages.append(Denoise(tuple(names), round(components), window_s))
    return (*stages, EstimateRoad(groups, context.setting("parameter_sigma")), Drop(CUTOFF))


def _watch(context: Context) -> list[Stage]:
    """Compare the deflection with the heights of body and wheel, where all are known."""
    placed = {m.quantity: m.displacement_name for m in _motions(context) if m.placed}
    if not (_uses_deflection(context) and {"sprung", "unsprung"} <= set(placed)):
        return []
    sigma_m = context.setting("deflection_sigma_m")
    return [CompareTravel(DEFLECTION, placed["sprung"], placed["unsprung"], sigma_m)]


def _tyres(context: Context) -> dict[str, list[float]]:
    """Return the positions of every wheel path's tyres, in m ahead of the model's own point."""
    found: dict[str, list[float]] = {track: [] for track in context.header.tracks}
    for tyre in vehicle_model(context.header.setup).tyres:
        for track in (tyre.track,) if tyre.track else context.header.tracks:
            found[track].append(tyre.x_m)
    return found


SETTINGS: dict[str, float | None] = {
    **{name: value for name, value in ADAPTIVE.items() if name != "anti_alias_hz"},
    "distance_scale_sigma": 2e-4,
    "points_per_m": 20.0,
    "contact_m": 0.25,
    "parameter_sigma": 0.03,
    "acceleration_density": 1e-3,
    "angular_acceleration_density": 1e-3,
    "deflection_sigma_m": 5e-4,
    "displacement_sigma": 1e-3,
    "velocity_sigma": 1e-2,
    "angular_displacement_sigma": 1e-3,
    "angular_velocity_sigma": 1e-2,
    "denoise_components": None,
    "denoise_window_s": 0.5,
}
JOINT: dict[str, float | None] = {**SETTINGS, "body_disturbance": 0.5}
OBSERVER: dict[str, float | None] = {**SETTINGS, "position_gain_hz": 20.0, "rate_gain_hz": 0.5}


def _pipeline(
    name: str, summary: str, settings: dict[str, float | None], answers: dict[str, Answer]
) -> Pipeline:
    return Pipeline(
        name,
        "response",
        summary,
        settings,
        answers,
        capabilities=("response",),
        through_stops=False,
    )


RESPONSE = (
    _pipeline(
        "response-joint-input-state",
        "no height sensor: the road as the unknown input of a Kalman filter of the vehicle",
        JOINT,
        {},
    ),
    _pipeline(
        "response-observer",
        "the same by an observer of the vehicle's states",
        OBSERVER,
        {"response_estimate": estimate_observing},
    ),
)
