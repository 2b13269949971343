"""The ACME RoadLogger for floatref: its files, a stage against laser spikes, and a device.

An invented logger, as a template. Each part is in its own file.
"""

__version__ = "1.0"
