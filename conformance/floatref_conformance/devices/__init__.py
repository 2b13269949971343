"""Devices under test: what the judge calls, and the kinds that come with the suite."""
