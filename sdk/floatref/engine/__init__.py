"""Architectures: signal flows with named points, and the plug-ins that fill them."""
