"""The road from the vehicle's response: models, and estimators of unknown inputs.

Arrays in, arrays out. A model has the coordinates q of its freedoms and M·q'' + C·q' + K·q = S·F,
where F holds the forces k·u + c·u' of the tyres in N over the road u in m. States are x = (q, q').
"""

from floatref.response.calculation_rate import calculation_rate
from floatref.response.connections import Connection, connected
from floatref.response.denoising import denoised
from floatref.response.disturbance import disturbance_of, hold_error_of
from floatref.response.estimate import Estimate
from floatref.response.gains import default_gains
from floatref.response.half_car import ZHU_HALF_CAR, HalfCar
from floatref.response.joint_filter import JointInputState
from floatref.response.model import Freedom, Tyre, VehicleModel
from floatref.response.named import MODELS, model_of, parameters_of
from floatref.response.observability import (
    check_readings,
    missing_displacements,
    unfelt_tyres,
    unseen_freedoms,
)
from floatref.response.observer import UnknownInputObserver
from floatref.response.output import output_matrices
from floatref.response.quarter_car import QuarterCar
from floatref.response.reading import Kind, Reading
from floatref.response.resampling import Resampling
from floatref.response.state_space import Discrete, Hold, discretized, state_space
from floatref.response.trailer import IMINE_TRAILER, Trailer
from floatref.response.wheelbase import joined, joined_at_speed, shifted

__all__ = [
    "IMINE_TRAILER",
    "MODELS",
    "ZHU_HALF_CAR",
    "Connection",
    "Discrete",
    "Estimate",
    "Freedom",
    "HalfCar",
    "Hold",
    "JointInputState",
    "Kind",
    "QuarterCar",
    "Reading",
    "Resampling",
    "Trailer",
    "Tyre",
    "UnknownInputObserver",
    "VehicleModel",
    "calculation_rate",
    "check_readings",
    "connected",
    "default_gains",
    "denoised",
    "discretized",
    "disturbance_of",
    "hold_error_of",
    "joined",
    "joined_at_speed",
    "missing_displacements",
    "model_of",
    "output_matrices",
    "parameters_of",
    "shifted",
    "state_space",
    "unfelt_tyres",
    "unseen_freedoms",
]
