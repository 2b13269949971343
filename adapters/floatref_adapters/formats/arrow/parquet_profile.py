"""Profiles as Parquet: a column per quantity and wheel path, and what made them as metadata.

Columns are `distance_m`, then `<track>_elevation_m`, `<track>_valid` and, where it is known,
`<track>_sigma_m`; a missing elevation or 1-σ is null. The schema's metadata holds `format`,
`interval_m`, `start_m`, `pipeline` and, as JSON, `tracks`, `settings` and `provenance`.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, Profile, ProfileTrack, check_file, open_bytes
from floatref_adapters.formats.arrow.parquet_file import all_batches
from floatref_adapters.formats.arrow.parquet_footer import FORMAT, begins_as_parquet, holds_profile
from floatref_adapters.formats.arrow.parquet_pages import check_pages
from floatref_adapters.shared.profile_columns import (
    DISTANCE,
    make_columns,
    make_metadata,
    read_description,
)
from floatref_adapters.shared.refusals import library

ROWS = 1 << 17
"""Points of a row group, and points that are handled together."""
NEAR = 0.01
"""How far off its place a distance may be, in intervals."""

Floats = NDArray[np.float64]


class ParquetProfile:
    """The format of such files."""

    name = "parquet"
    suffix = ".parquet"
    summary = "Parquet: distance, elevation, validity, 1-σ, and what made them as metadata"

    def check_installed(self) -> None:
        """Raise InputError where pyarrow is missing."""
        _libraries("writing Parquet")

    def recognises(self, path: Path) -> bool:
        """Tell whether ``path`` is a Parquet file whose footer is that of a profile.

        One whose footer cannot be read is recognised: reading it says why.
        """
        return begins_as_parquet(path) and holds_profile(path) is not False

    def read(self, path: Path) -> Profile:
        """Return the profile in ``path``, as it was written.

        Raises InputError in one line naming the file where pyarrow is missing, and for anything
        else than such a file.
        """
        if not path.is_file():
            raise InputError(f"{path}: not a file; give a Parquet file")
        arrow, parquet = _libraries(f"{path}: reading Parquet")
        with (
            _explain(path, arrow),
            open_bytes(path) as stream,
            parquet.ParquetFile(check_file(path)) as file,
        ):
            return _profile(file, stream)

    def write(self, profile: Profile, path: Path) -> None:
        """Write ``profile`` to ``path``; InputError where pyarrow is missing."""
        arrow, parquet = _libraries(f"{path}: writing Parquet")
        with _explain(path, arrow):
            schema = _schema(profile, arrow)
            with parquet.ParquetWriter(path, schema, compression="zstd") as writer:
                for first in range(0, profile.tracks[0].elevation.size, ROWS):
                    columns = make_columns(profile, first, first + ROWS)
                    arrays = [arrow.array(c, from_pandas=True) for c in columns.values()]
                    writer.write_table(arrow.Table.from_arrays(arrays, schema=schema), ROWS)


def _libraries(task: str) -> tuple[Any, Any]:
    return library("pyarrow", task), library("pyarrow.parquet", task)


@contextmanager
def _explain(path: Path, arrow: Any) -> Iterator[None]:
    """Name ``path`` in every refusal, those of pyarrow included."""
    try:
        yield
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    except (arrow.ArrowException, OSError, ValueError, OverflowError) as error:
        reason = " ".join(str(error).split())[:160]
        raise InputError(f"{path}: not to be used as Parquet ({reason}); copy it again") from error


def _schema(profile: Profile, arrow: Any) -> Any:
    types = {
        name: arrow.bool_() if values.dtype == np.bool_ else arrow.float64()
        for name, values in make_columns(profile, 0, 1).items()
    }
    fields = [arrow.field(name, kind) for name, kind in types.items()]
    return arrow.schema(fields, metadata={"format": FORMAT, **make_metadata(profile)})


def _profile(file: Any, stream: BinaryIO) -> Profile:
    metadata = {
        key.decode("utf-8", "replace"): value.decode("utf-8", "replace")
        for key, value in (file.schema_arrow.metadata or {}).items()
    }
    if metadata.get("format") != FORMAT:
        held = metadata.get("format", "missing")[:40]
        raise InputError(f"metadata format is {held}; it must be {FORMAT}, as floatref writes it")
    description = read_description(metadata)
    there = file.schema_arrow.names
    names = [*description.columns, *(name for name in description.sigma_columns if name in there)]
    _check_columns(there, names)
    parts: dict[str, list[NDArray[Any]]] = {name: [] for name in names}
    done = 0
    check_pages(stream, names)
    for batch in all_batches(file, ROWS, names):
        _check_distance(_floats(batch, DISTANCE), description.start_m, description.interval_m, done)
        for name, values in parts.items():
            values.append(_flags(batch, name) if name.endswith("_valid") else _floats(batch, name))
        done += batch.num_rows
    if done == 0:
        raise InputError("no points; copy the complete file")
    found = {name: np.concatenate(values) for name, values in parts.items()}
    return description.profile([_track(name, found) for name in description.tracks])


def _check_columns(there: list[str], names: list[str]) -> None:
    for name in names:
        if there.count(name) != 1:
            held = ", ".join(there[:12])
            raise InputError(f"column {name}: {there.count(name)} of it among {held}; needs one")


def _floats(batch: Any, name: str) -> Floats:
    values: NDArray[Any] = batch.column(name).to_numpy(zero_copy_only=False)
    if values.dtype.kind not in "fiu":
        raise InputError(f"column {name} holds {batch.schema.field(name).type}; it needs numbers")
    return values.astype(np.float64)


def _flags(batch: Any, name: str) -> NDArray[np.bool_]:
    column = batch.column(name)
    if str(column.type) != "bool":
        raise InputError(f"column {name} holds {column.type}; it needs true and false")
    flags: NDArray[np.bool_] = column.fill_null(False).to_numpy(zero_copy_only=False)
    return flags


def _check_distance(distance: Floats, start_m: float, interval_m: float, done: int) -> None:
    expected = start_m + interval_m * np.arange(done, done + distance.size)
    near = np.abs(distance - expected) <= NEAR * interval_m + 1e-12 * np.abs(expected)
    if not near.all():
        bad = int(np.argmin(near))
        raise InputError(
            f"point {done + bad}: distance_m is {distance[bad]:.10g}, but start_m and interval_m "
            f"put it at {expected[bad]:.10g}"
        )


def _track(name: str, columns: dict[str, NDArray[Any]]) -> ProfileTrack:
    return ProfileTrack.of(
        name,
        columns[f"{name}_elevation_m"],
        columns[f"{name}_valid"],
        columns.get(f"{name}_sigma_m"),
    )
