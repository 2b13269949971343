"""The checks: the requirements for a device, their reasons and their limits."""
