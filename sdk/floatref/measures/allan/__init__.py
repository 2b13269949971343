"""The noise of sensors at rest, by Allan deviation."""
