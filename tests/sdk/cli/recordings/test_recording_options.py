"""Commands that read a recording beside a profile ask for it by the same words."""

import click
import pytest

from floatref.cli.main import main
from floatref.cli.recordings.recording_options import RecordingReader

SHARED = ("--adapter", "--map", "--overwrite")


def options_of(command: str) -> dict[str, click.Option]:
    found = main.get_command(click.Context(main), command)
    assert found is not None
    return {name: p for p in found.params if isinstance(p, click.Option) for name in p.opts}


@pytest.mark.parametrize("option", SHARED)
def test_one_help_text_for_one_option(option: str) -> None:
    helps = {options_of(command)[option].help for command in ("view", "plot", "iri", "roughness")}
    assert len(helps) == 1


@pytest.mark.parametrize("command", ["view", "iri", "roughness"])
def test_the_recording_beside_a_profile_is_one_option(command: str) -> None:
    assert isinstance(options_of(command)["--recording"].type, click.Path)
    assert "ecording" in str(options_of(command)["--recording"].help)


@pytest.mark.parametrize("stated", [{"adapter": "csv"}, {"channel_map": "m.toml"}])
def test_an_adapter_or_a_map_states_a_recording(stated) -> None:
    assert RecordingReader(**stated).is_stated
    assert not RecordingReader().is_stated
