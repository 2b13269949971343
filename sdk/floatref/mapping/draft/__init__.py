"""A draft of a channel map, guessed from names, units and data."""
