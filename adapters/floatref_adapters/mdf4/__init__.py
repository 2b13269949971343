"""ASAM MDF 4."""
