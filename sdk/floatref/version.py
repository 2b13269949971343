"""The version of floatref: read by the packaging, the commands and every profile."""

__version__ = "0.1.0"
