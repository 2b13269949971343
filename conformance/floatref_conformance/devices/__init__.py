"""Devices under test: the interface that the judge calls, and the kinds of the suite."""
