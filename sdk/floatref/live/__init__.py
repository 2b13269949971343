"""Profiles while the vehicle drives: windows of a run, and the stream that makes them."""
