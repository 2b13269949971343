"""`python -m floatref_conformance` is the `conformance` command."""

from floatref_conformance.cli.main import main

main()
