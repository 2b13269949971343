"""Signal flows with named points, the built-in pipelines, and the plug-in that registers them."""
