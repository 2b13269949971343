"""Files seen through a map, and what happens when one is cut while it is read."""
