"""Compiled loops; each kernel is checked against the reference implementation."""
