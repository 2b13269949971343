"""What an HDF5 file holds: its groups, and in each the datasets with their attributes.

Only hard links are followed, each object once: links to other files, virtual datasets, data in
other files and references are counted and left alone.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from floatref import InputError, check_file
from floatref_adapters.shared.refusals import library
from floatref_adapters.shared.stated_clock import RATES, STARTS, STEPS

MOST_OBJECTS = 20_000
LONGEST_ATTRIBUTE = 1000
"""Elements of an attribute that is read."""
_MEANT = "unit units _fillvalue missing_value scale_factor add_offset matlab_class vendor model"
MEANT = frozenset(_MEANT.split()) | RATES | STEPS | STARTS
"""Attributes that are read, in small letters. Others may be damaged, and are not used."""
TROUBLE = (OSError, RuntimeError, ValueError, TypeError, LookupError, AttributeError, MemoryError)
"""What h5py raises for damaged files."""


@dataclass(frozen=True, eq=False)
class Dataset:
    """A dataset as its header describes it; ``scale`` is the path of its axis of time, or ""."""

    path: str
    name: str
    shape: tuple[int, ...]
    dtype: Any
    attributes: Mapping[str, Any]
    scale: str = ""
    elsewhere: bool = False
    stored: bool = True


@dataclass(frozen=True, eq=False)
class Group:
    """A group: its path without the leading slash, attributes and datasets.

    Single numbers that are datasets, as MATLAB writes them, are among the attributes.
    """

    path: str
    attributes: Mapping[str, Any]
    datasets: tuple[Dataset, ...]


@dataclass
class Tree:
    """The groups of a file that hold datasets, its attributes, what was left alone by kind."""

    attributes: Mapping[str, Any]
    groups: list[Group] = field(default_factory=list)
    left: Counter[str] = field(default_factory=Counter)


@contextmanager
def open_hdf5(path: Path) -> Iterator[Any]:
    """Yield the HDF5 file at ``path``; InputError in one line for what goes wrong with it."""
    h5py = library("h5py", "reading HDF5")
    try:
        with h5py.File(check_file(path), "r", locking=False) as file:
            yield file
    except InputError:
        raise
    except TROUBLE as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise InputError(f"no sound HDF5 ({reason[:120]}); copy the complete file again") from error


def read_tree(file: Any) -> Tree:
    """Return what ``file``, an opened HDF5 file, holds; InputError for too many objects."""
    tree, waiting, seen = Tree(read_attributes(file)), [("", file["/"])], {_address(file["/"])}
    while waiting:
        path, group = waiting.pop(0)
        datasets, single = [], {}
        for name, item in _items(group, tree.left):
            if _address(item) in seen:
                tree.left["further links to the same object"] += 1
                continue
            seen.add(_address(item))
            if len(seen) > MOST_OBJECTS:
                raise InputError(f"more than {MOST_OBJECTS} objects; write fewer into a file")
            below = f"{path}/{name}" if path else name
            if hasattr(item, "keys"):
                waiting.append((below, item))
            elif hasattr(item, "shape"):
                datasets.append(_dataset(below, name, item, tree.left))
                single.update(_single(name, item))
        if datasets:
            tree.groups.append(Group(path, {**single, **read_attributes(group)}, tuple(datasets)))
    return tree


def _single(name: str, item: Any) -> dict[str, Any]:
    """Return the number in a dataset of one number that is named like a rate; MATLAB has no other.

    The attributes of a group mean the same.
    """
    if name.lower() not in RATES | STEPS | STARTS or item.size != 1 or item.is_virtual:
        return {}
    return {name: item[()]} if item.dtype.kind in "iuf" else {}


def _items(group: Any, left: Counter[str]) -> Iterator[tuple[str, Any]]:
    """Yield names and objects behind the hard links of ``group``, but MATLAB's own."""
    h5py = library("h5py", "reading HDF5")
    for name in group:
        link = group.get(name, getlink=True)
        if isinstance(link, h5py.ExternalLink):
            left["links to other files"] += 1
        elif isinstance(link, h5py.SoftLink):
            left["soft links"] += 1
        elif not name.startswith("#"):
            try:
                yield name, group[name]
            except TROUBLE:
                left["objects that cannot be opened"] += 1


def _address(item: Any) -> tuple[int, int]:
    info = library("h5py", "reading HDF5").h5o.get_info(item.id)
    return info.fileno, info.addr


def _dataset(path: str, name: str, item: Any, left: Counter[str]) -> Dataset:
    elsewhere = bool(item.is_virtual or item.external)
    if elsewhere:
        left["datasets whose data are in other files"] += 1
    try:
        dtype = item.dtype
    except TROUBLE:
        left["datasets of an unknown type"] += 1
        dtype = None
    stored = item.id.get_storage_size() > 0
    if not stored and item.size:
        left["datasets without data"] += 1
    shape = tuple(item.shape or ())
    return Dataset(path, name, shape, dtype, read_attributes(item), _scale(item), elsewhere, stored)


def read_attributes(item: Any) -> dict[str, Any]:
    """Return the attributes of ``item`` that mean something here, are short and can be read."""
    found = {}
    for name in item.attrs:
        if name.lower() not in MEANT:
            continue
        try:
            shape = item.attrs.get_id(name).shape or ()
            if len(shape) < 2 and all(size <= LONGEST_ATTRIBUTE for size in shape):
                found[name] = item.attrs[name]
        except TROUBLE:
            continue
    return found


def decode_text(value: Any) -> str:
    """Return an attribute as text, "" if it is not text."""
    value = getattr(value, "tolist", lambda: value)()
    while isinstance(value, list) and len(value) == 1:
        value = value[0]
    if isinstance(value, bytes):
        value = value.decode("utf-8", "replace")
    return value.strip("\0 ") if isinstance(value, str) else ""


def _scale(item: Any) -> str:
    """Return the path of the dimension scale of the first axis, "" if it is missing."""
    try:
        scales = list(item.dims[0].values()) if item.shape else []
        return str(scales[0].name or "").lstrip("/") if scales else ""
    except TROUBLE:
        return ""
