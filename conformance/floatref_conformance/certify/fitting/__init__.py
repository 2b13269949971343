"""How a run lies on the reference: scales of distance and heights, from windows."""
