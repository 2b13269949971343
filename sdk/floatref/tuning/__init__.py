"""Tuning of the Kalman pipelines to preliminary runs of known profile (section 6.4.4)."""

from floatref.tuning.tune import Tuning, tune

__all__ = ["Tuning", "tune"]
