"""The stages in C99 for firmware: sources to build, no compiled code; see docs/c-library.md."""
