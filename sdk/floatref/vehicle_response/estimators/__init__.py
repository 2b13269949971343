"""Estimators of the road as the unknown input of a vehicle's model."""
