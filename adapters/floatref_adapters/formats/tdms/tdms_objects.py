"""The channels and segments of a TDMS file, by npTDMS's own reader of segments.

`TdmsFile` has the last value of a property only, and does not say where values are. Both are
needed: a recorder states a new waveform as it begins, and `data_chunks` reads a chunk as a whole,
however long it is. So the segments are walked here, and npTDMS reads the metadata of each.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from typing import Any, BinaryIO

TIMING = ("wf_increment", "wf_start_offset", "wf_start_time")
SCALING = ("NI_Scale", "NI_Number_Of_Scales", "NI_Scaling_Status", "unit_string")
"""How the names of the properties begin that values and units come from."""

History = Sequence[tuple[int, Any]]
"""What a property was, each value with the number of the first sample that it holds for."""


@dataclass(eq=False)
class StoredObject:
    """A channel, a group or the file: its properties, the type and the count of its values.

    ``depth`` is 2 for a channel, 1 for a group, 0 for the file. ``changes`` are the
    histories of the properties that changed between two values.
    """

    path: str
    depth: int
    group: str
    name: str
    properties: dict[str, Any] = field(default_factory=dict)
    data_type: Any = None
    scaler_data_types: Any = None
    count: int = 0
    changes: dict[str, list[tuple[int, Any]]] = field(default_factory=dict)

    def state(self, properties: Sequence[tuple[str, Any]]) -> None:
        """Take ``properties``, which hold for the values that come."""
        for name, value in properties:
            had = self.properties.get(name, value)
            if self.count and name.startswith((*TIMING, *SCALING)) and had != value:
                self.changes.setdefault(name, [(0, had)]).append((self.count, value))
            self.properties[name] = value

    def add_values(self, stored: Any, count: int) -> None:
        """Add ``count`` values; ValueError if they are of another type than those before."""
        if self.data_type not in (None, stored.data_type):
            raise ValueError(f"{self.path} has values of several types")
        self.data_type = stored.data_type
        if stored.scaler_data_types is not None:
            if self.scaler_data_types not in (None, stored.scaler_data_types):
                raise ValueError(f"{self.path} has raw values of several types")
            self.scaler_data_types = stored.scaler_data_types
        self.count += count

    @property
    def histories(self) -> dict[str, History]:
        """The properties that differ among the values.

        What is stated after the last of them was written is meant for all, as npTDMS takes it.
        """
        return {name: past for name, past in self.changes.items() if past[-1][0] < self.count}


@dataclass(eq=False)
class Contents:
    """The segments of a file as npTDMS has them, and its objects by path."""

    segments: list[Any] = field(default_factory=list)
    objects: dict[str, StoredObject] = field(default_factory=dict)

    @property
    def properties(self) -> Mapping[str, Any]:
        """The properties of the file."""
        return self.objects["/"].properties if "/" in self.objects else {}

    def groups(self) -> dict[str, tuple[Mapping[str, Any], list[StoredObject]]]:
        """Return the properties and channels of each group by its name."""
        stated = {o.group: o.properties for o in self.objects.values() if o.depth == 1}
        channels: defaultdict[str, list[StoredObject]] = defaultdict(list)
        for item in self.objects.values():
            if item.depth == 2:
                channels[item.group].append(item)
        names = dict.fromkeys(chain(stated, channels))
        return {name: (stated.get(name, {}), channels[name]) for name in names}

    @property
    def cut_off(self) -> bool:
        """Whether the last segment is shorter than it says."""
        return bool(self.segments and self.segments[-1].segment_incomplete)

    def count_lost(self) -> dict[str, int]:
        """Return how many values of the last chunk are missing, by the paths of the channels."""
        last = self.segments[-1].final_chunk_lengths_override if self.segments else None
        if last is None:
            return {}
        items = [item for item in self.segments[-1].ordered_objects if item.has_data]
        lost = {item.path: item.number_values - last.get(item.path, 0) for item in items}
        return {path: count for path, count in lost.items() if count > 0}

    def add(self, segment: Any, stated: Mapping[str, Any] | None) -> None:
        """Take a segment and the properties that its metadata state, by path."""
        for item in segment.ordered_objects:
            self._object(item.path)
        for path, properties in (stated or {}).items():
            self._object(path).state(properties)
        for item in segment.ordered_objects:
            self._object(item.path).add_values(item, _count_values(item, segment))
        self.segments.append(segment)

    def _object(self, path: str) -> StoredObject:
        if path not in self.objects:
            self.objects[path] = StoredObject(path, *_split_path(path))
        return self.objects[path]


def _split_path(path: str) -> tuple[int, str, str]:
    """Return how deep an object is, and the names of its group and channel."""
    from nptdms.common import ObjectPath

    parsed = ObjectPath.from_string(path)
    depth = (parsed.group is not None) + (parsed.channel is not None)
    return depth, parsed.group or "", parsed.channel or ""


def _count_values(item: Any, segment: Any) -> int:
    last = segment.final_chunk_lengths_override
    if not item.has_data:
        return 0
    if last is None:
        return int(item.number_values * segment.num_chunks)
    return int(item.number_values * (segment.num_chunks - 1) + last.get(item.path, 0))


def read_contents(file: BinaryIO, leads: Iterable[tuple[int, int, int, int, bool]]) -> Contents:
    """Return what ``file`` holds; ``leads`` are what `TdmsSegment` of npTDMS needs of a segment.

    Raises what npTDMS raises for damaged metadata.
    """
    from nptdms.tdms_segment import TdmsSegment

    contents, latest, before = Contents(), dict[str, Any](), None
    for lead in leads:
        segment = TdmsSegment(*lead)
        stated = segment.read_segment_objects(file, latest, None, before)
        latest.update((item.path, item) for item in segment.ordered_objects)
        contents.add(segment, stated)
        before = segment
    return contents
