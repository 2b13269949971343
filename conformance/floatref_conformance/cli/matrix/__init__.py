"""`conformance matrix`."""
