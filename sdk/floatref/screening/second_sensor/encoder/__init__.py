"""The encoder against places of GNSS, the longitudinal force, and itself."""
