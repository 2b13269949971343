"""The checks that have a vehicle drive over a road."""
