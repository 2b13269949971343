"""The checks in which a vehicle drives over a road."""
