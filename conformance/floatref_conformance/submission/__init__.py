"""A verdict that others can check: one archive with all that it rests on, and what repeats it."""
