"""Stages of the response architecture: calculation rate, estimator, and the way to the profile."""

from floatref.vehicle_response.stages.along import Abeam, ShiftAlong
from floatref.vehicle_response.stages.calculation_rate import ToRate
from floatref.vehicle_response.stages.contact import RestoreContact
from floatref.vehicle_response.stages.deflection import CompareTravel
from floatref.vehicle_response.stages.denoising import Denoise
from floatref.vehicle_response.stages.estimation import EstimateRoad
from floatref.vehicle_response.stages.estimators import Group, WithPlaces
from floatref.vehicle_response.stages.joining import JoinTyres

__all__ = [
    "Abeam",
    "CompareTravel",
    "Denoise",
    "EstimateRoad",
    "Group",
    "JoinTyres",
    "RestoreContact",
    "ShiftAlong",
    "ToRate",
    "WithPlaces",
]
