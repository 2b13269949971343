"""Vehicles of the proving ground, and how they move over a road."""
