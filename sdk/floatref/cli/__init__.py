"""The `floatref` command, one module per sub-command."""
