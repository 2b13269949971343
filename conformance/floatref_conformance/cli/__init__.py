"""The `conformance` command, one module per sub-command."""
