"""What floatref finds through the entry point: an adapter, a stage and a pipeline."""

from collections.abc import Callable

from acme_roadlogger.adapter import RoadLogger
from acme_roadlogger.pipeline import PIPELINE
from acme_roadlogger.spikes import RemoveSpikes
from floatref import Adapter, Pipeline, Stage, hookimpl


@hookimpl
def floatref_register_adapters(register: Callable[[Adapter], None]) -> None:
    """Read our files."""
    register(RoadLogger())


@hookimpl
def floatref_register_stages(register: Callable[[str, Callable[..., Stage]], None]) -> None:
    """Offer our stage to other pipelines."""
    register("RemoveSpikes", RemoveSpikes)


@hookimpl
def floatref_register_pipelines(register: Callable[[Pipeline], None]) -> None:
    """Add our pipeline."""
    register(PIPELINE)
