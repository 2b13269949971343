"""The road from the vehicle's response: models, and estimators of unknown inputs.

Arrays in, arrays out. A model has the coordinates q of its freedoms and M·q'' + C·q' + K·q = S·F,
where F holds the forces k·u + c·u' of the tyres in N over the road u in m. States are x = (q, q').
"""

from floatref.vehicle_response.estimators.disturbance import disturbance_of, hold_error_of
from floatref.vehicle_response.estimators.estimate import Estimate
from floatref.vehicle_response.estimators.gains import default_gains
from floatref.vehicle_response.estimators.joint_filter import JointInputState
from floatref.vehicle_response.estimators.observability import (
    check_readings,
    missing_displacements,
    unfelt_tyres,
    unseen_freedoms,
)
from floatref.vehicle_response.estimators.observer import UnknownInputObserver
from floatref.vehicle_response.estimators.wheelbase import join_at_speed, join_roads, shift
from floatref.vehicle_response.models.connections import Connection, connect
from floatref.vehicle_response.models.half_car import ZHU_HALF_CAR, HalfCar
from floatref.vehicle_response.models.model import Freedom, Tyre, VehicleModel
from floatref.vehicle_response.models.named import MODELS, model_of, parameters_of
from floatref.vehicle_response.models.outputs import Kind, Reading, output_matrices
from floatref.vehicle_response.models.quarter_car import QuarterCar
from floatref.vehicle_response.models.state_space import Discrete, Hold, discretize, state_space
from floatref.vehicle_response.models.trailer import IMINE_TRAILER, Trailer
from floatref.vehicle_response.stages.calculation_rate import calculation_rate
from floatref.vehicle_response.stages.denoising import remove_noise
from floatref.vehicle_response.stages.lower_rate import Resampling

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
    "connect",
    "default_gains",
    "discretize",
    "disturbance_of",
    "hold_error_of",
    "join_at_speed",
    "join_roads",
    "missing_displacements",
    "model_of",
    "output_matrices",
    "parameters_of",
    "remove_noise",
    "shift",
    "state_space",
    "unfelt_tyres",
    "unseen_freedoms",
]
