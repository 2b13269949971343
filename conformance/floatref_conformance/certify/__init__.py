"""Certification of a real profiler from recorded runs: the worksheet of AASHTO R 56 and R 57."""
