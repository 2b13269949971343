"""Rows of which few unknowns are together, and how they are solved."""
