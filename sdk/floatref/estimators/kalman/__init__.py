"""The multi-rate extended Kalman filter and smoother of chapter 6, as stages."""

from floatref.estimators.kalman.filter import KalmanFilter
from floatref.estimators.kalman.noise import Noise
from floatref.estimators.kalman.references import Plan
from floatref.estimators.kalman.smoother import KalmanSmoother

__all__ = ["KalmanFilter", "KalmanSmoother", "Noise", "Plan"]
