"""The checks: what each asks of a device, why, and how much is allowed."""
