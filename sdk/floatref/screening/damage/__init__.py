"""Samples that are there and measure nothing: saturated, stuck, lost counts of the encoder."""
