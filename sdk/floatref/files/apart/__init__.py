"""Files that are read in a process of its own, for their libraries crash, hang or swell."""
