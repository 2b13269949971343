"""Faults of sensors and recorders, and a study of what each pipeline makes of them."""
