"""Logs of NovAtel OEM receivers."""
