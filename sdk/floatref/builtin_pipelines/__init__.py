"""The signal flows with named points, the built-in pipelines, and the plug-in that brings them."""
