"""How a drive goes through a stage."""

import pytest

from floatref.values.block import join_blocks


@pytest.fixture(scope="session")
def through():
    """Return what runs a drive through a stage, cut before some samples: all that comes out."""

    def run(stage, drive, cuts=()):
        stage.start(drive.header)
        out = [stage.push(block) for block in drive.blocks(cuts)]
        return join_blocks([block for block in (*out, *stage.finish()) if len(block)])

    return run
