"""The checks of a parked vehicle, and the plate that must be in its profile."""
