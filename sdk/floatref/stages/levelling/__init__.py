"""Levelling: the vertical acceleration by the attitude that an inertial unit measures."""

from floatref.stages.levelling.stage import Level

__all__ = ["Level"]
