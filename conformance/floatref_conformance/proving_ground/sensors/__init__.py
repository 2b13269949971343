"""Sensors of the proving ground: what they deliver, with every error."""
