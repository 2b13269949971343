"""What the drives of most benchmarks have in common: slip, and the place of the laser."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

KIND: Mapping[str, Any] = MappingProxyType({"slip_percent_per_g": 0.3, "laser_ahead_m": 0.0})
"""An encoder that hardly slips and a laser at its accelerometer, with which the figures of the
pages were measured. `bench_streets.py` has more slip, other places of the laser and other roads,
and docs/families.md has them for every pipeline."""
