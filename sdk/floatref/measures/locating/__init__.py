"""Finding a run on the reference: place, direction, units, lag and scale."""
