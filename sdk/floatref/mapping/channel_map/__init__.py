"""The channel map: what in a native file is which channel, in which unit."""
