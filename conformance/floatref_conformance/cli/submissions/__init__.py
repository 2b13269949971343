"""`conformance submit` and `conformance verify`."""
