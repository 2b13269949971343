"""Comparing runs with the reference, and judging them by the limits."""
