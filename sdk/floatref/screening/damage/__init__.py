"""Samples that are present but measure nothing: saturated, stuck, lost encoder counts."""
