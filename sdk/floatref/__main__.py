"""`python -m floatref` is the `floatref` command."""

from floatref.cli.main import main

main()
