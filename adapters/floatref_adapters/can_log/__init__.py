"""Logs of CAN buses."""
