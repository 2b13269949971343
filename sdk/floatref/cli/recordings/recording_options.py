"""Options by which a command reads a recording, alone or beside a profile, and what they give.

One place for `view`, `plot` and for `--gis` of `iri` and `roughness`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from floatref.values.recording import Recording

if TYPE_CHECKING:
    from floatref.mapping.sources import Source

F = TypeVar("F", bound=Callable[..., Any])
Option = Callable[[F], F]

READING = (
    click.option("--adapter", metavar="NAME", help="Read the recording with this adapter."),
    click.option(
        "--map",
        "channel_map",
        type=click.Path(path_type=Path),
        metavar="FILE.toml",
        help="Channel map of the recording, if it is a native file.",
    ),
    click.option("--overwrite", is_flag=True, help="Replace an existing target."),
)
"""Options ``adapter``, ``channel_map`` and ``overwrite``."""


def beside(text: str) -> Option[Any]:
    """Return the option `--recording`, with ``text`` as its help."""
    return click.option("--recording", type=click.Path(path_type=Path), help=text)


def add_options(command: F, options: Sequence[Option[Any]]) -> F:
    """Return ``command`` with ``options``, in their order."""
    return reduce(lambda found, option: option(found), reversed(options), command)


@dataclass(frozen=True)
class RecordingReader:
    """How a recording is read: by a named adapter, by a channel map, or as it is recognised."""

    adapter: str | None = None
    channel_map: Path | None = None

    @property
    def is_stated(self) -> bool:
        """Whether an adapter or a map is given, so that the source is a recording."""
        return self.adapter is not None or self.channel_map is not None

    def source_at(self, path: Path) -> "Source":
        """Return the recording at ``path`` with its origin; its warnings go to stderr, a line each.

        Raises InputError for what cannot be used.
        """
        from floatref.mapping.sources import recording_of

        source = recording_of(path, self.adapter, self.channel_map)
        for line in source.warnings:
            click.echo(f"Warning: {line}", err=True)
        return source

    def recording_at(self, path: Path) -> Recording:
        """Return the recording at ``path``, as `source_at` reads it."""
        return self.source_at(path).recording
