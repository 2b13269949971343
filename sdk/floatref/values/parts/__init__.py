"""A part of a value, and what a picture needs of a long one."""
