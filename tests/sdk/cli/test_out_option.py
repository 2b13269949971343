"""Where a command writes is `-o` or `--out`, in every command that writes to one place."""

import click
import numpy as np
import pytest

from floatref.cli.main import main as floatref
from floatref.files import read_profile, write_profile
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.cli.main import main as conformance


def commands(group):
    for name in group.list_commands(None):
        command = group.get_command(None, name)
        if isinstance(command, click.Group):
            yield from commands(command)
        else:
            yield pytest.param(command, id=f"{group.name}-{name}")


@pytest.mark.parametrize("command", [*commands(floatref), *commands(conformance)])
def test_out_has_its_short_form_and_no_other_option_has_it(command):
    given = [param.opts for param in command.params if {"-o", "--out"} & set(param.opts)]
    assert all(options == ["-o", "--out"] for options in given)
    assert len(given) <= 1


def test_convert_writes_to_it(tmp_path, ran):
    write_profile(Profile(0.05, (ProfileTrack.of("main", np.arange(9.0)),)), tmp_path / "road")
    ran("convert", tmp_path / "road", "-o", tmp_path / "road.csv")
    assert read_profile(tmp_path / "road.csv")["main"].elevation.tolist() == list(range(9))
