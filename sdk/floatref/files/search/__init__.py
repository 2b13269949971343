"""Searches of folders for files: counted, and bounded."""
