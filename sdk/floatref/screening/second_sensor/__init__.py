"""A fault is found by a second sensor that measures the same motion."""
