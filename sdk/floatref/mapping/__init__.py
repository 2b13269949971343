"""Native files as recordings: a channel map assigns their columns to channels.

Names, units, signs, axes, delays and clocks are settled here; samples go to disk once, in SI
units, so that memory does not grow with the file. Nothing is resampled.
"""

from floatref.mapping.channel_map.map_document import read_map
from floatref.mapping.reading import Reading, read_native

__all__ = ["Reading", "read_map", "read_native"]
