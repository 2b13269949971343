"""ERD, out and in."""
