"""Stages of the response architecture: calculation rate, estimator, and the way to the profile."""

from floatref.stages.response.along import ShiftAlong
from floatref.stages.response.contact import RestoreContact
from floatref.stages.response.denoising import Denoise
from floatref.stages.response.estimation import EstimateRoad
from floatref.stages.response.estimators import Group, WithPlaces
from floatref.stages.response.joining import JoinTyres
from floatref.stages.response.rate import ToRate
from floatref.stages.response.travel import CompareTravel

__all__ = [
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
