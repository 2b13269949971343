"""The multi-rate extended Kalman filter and smoother of chapter 6, as stages."""

from floatref.stages.kalman.filter import KalmanFilter
from floatref.stages.kalman.noise import Noise
from floatref.stages.kalman.references import Plan
from floatref.stages.kalman.smoother import KalmanSmoother

__all__ = ["KalmanFilter", "KalmanSmoother", "Noise", "Plan"]
