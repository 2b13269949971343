"""The checks of a parked vehicle, and the plate that its profile must contain."""
