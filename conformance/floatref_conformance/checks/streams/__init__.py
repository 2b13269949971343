"""The checks of devices that stream: what a point may depend on, and when it is there."""
