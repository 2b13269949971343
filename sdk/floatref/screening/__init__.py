"""Checks of a recording: units, signs, axes, clocks, sensor positions and damaged samples."""
