"""The plan of a certification: sections, runs, and the profiles that they are read from."""
