"""`python -m floatref` is the `floatref` command."""

from floatref.cli.program.starting import start

start()
