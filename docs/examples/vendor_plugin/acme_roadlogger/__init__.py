"""The ACME RoadLogger for floatref: its files, a stage against laser spikes, and a device.

An invented logger, to be copied from. Each part stands in a file of its own.
"""

__version__ = "1.0"
