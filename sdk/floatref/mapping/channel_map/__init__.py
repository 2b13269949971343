"""The channel map: which column of a native file is which channel, in which unit."""
