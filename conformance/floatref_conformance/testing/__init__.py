"""Tests for vendors who write Python: subclass them in your own test suite.

`StageLaws` tests a stage by the laws of the stage protocol, `DeviceChecks` tests a device by the
checks of the conformance suite. Both are plain classes that pytest collects.
"""

from floatref_conformance.testing.device_checks import DeviceChecks
from floatref_conformance.testing.stage_laws import StageLaws
from floatref_conformance.testing.streams import Stream

__all__ = ["DeviceChecks", "StageLaws", "Stream"]
