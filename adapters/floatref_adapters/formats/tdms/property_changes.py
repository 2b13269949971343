"""Properties of TDMS channels that change on the way, of which npTDMS keeps the last value only."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, BinaryIO

TIMING = ("wf_increment", "wf_start_offset", "wf_start_time")
SCALING = ("NI_Scale", "NI_Number_Of_Scales", "NI_Scaling_Status", "unit_string")
"""How the names of the properties begin that values and units come from."""

History = Sequence[tuple[int, Any]]
"""What a property was from which value of its channel on."""


@dataclass(eq=False)
class Changes:
    """What ``reader`` of npTDMS meets while it reads what a file says of its channels."""

    found: dict[str, dict[str, list[tuple[int, Any]]]] = field(
        default_factory=lambda: defaultdict(dict)
    )
    _before: dict[str, int] = field(default_factory=dict)

    def watch(self, reader: Any) -> None:
        """See every property before ``reader`` forgets the value that it had."""
        take, keep = reader._update_object_metadata, reader._update_object_properties
        known = reader.object_metadata

        def taking(segment: Any) -> None:
            paths = (item.path for item in segment.ordered_objects)
            self._before = {path: known[path].num_values for path in paths if path in known}
            take(segment)

        def keeping(stated: Mapping[str, Sequence[tuple[str, Any]]] | None) -> None:
            for path, properties in (stated or {}).items():
                if self._before.get(path):
                    self._compare(path, known[path].properties, properties)
            keep(stated)

        reader._update_object_metadata, reader._update_object_properties = taking, keeping

    def _compare(
        self, path: str, had: Mapping[str, Any], properties: Sequence[tuple[str, Any]]
    ) -> None:
        for name, value in properties:
            if not name.startswith((*TIMING, *SCALING)) or had.get(name, value) == value:
                continue
            history = self.found[path].setdefault(name, [(0, had[name])])
            history.append((self._before[path], value))

    def of(self, path: str, count: int) -> dict[str, History]:
        """Return the histories of those properties that differ among the ``count`` values.

        What is stated after the last of them was written is meant for all, as npTDMS takes it.
        """
        return {
            name: history
            for name, history in self.found.get(path, {}).items()
            if history[-1][0] < count
        }


def watched(file: BinaryIO) -> tuple[Any, Changes]:
    """Return npTDMS's TdmsFile of ``file``, and how its properties change."""
    from nptdms import TdmsFile

    changes = Changes()

    class Watched(TdmsFile):  # type: ignore[misc]
        def _read_file(self, reader: Any, *rest: Any) -> None:
            changes.watch(reader)
            super()._read_file(reader, *rest)

    options: Any = {"raw_timestamps": True, "read_metadata_only": True, "keep_open": True}
    return Watched(file, **options), changes
