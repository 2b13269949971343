"""Clocks aligned with each other, and sensors that are late or wrongly scaled."""
