"""What is done around numba's compilation: its cache, its trace, and no search for garbage."""
