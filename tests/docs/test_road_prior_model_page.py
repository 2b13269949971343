"""The page on the road prior's model: its names exist, and its numbers are those of the code."""

import importlib
import re
from pathlib import Path
from typing import Any

import pytest

from floatref.builtin_pipelines.road_prior import CONSTANTS, ROAD_PRIOR
from floatref.estimators.road_prior import RoadPrior
from floatref.stages.signals import DISTANCE, HEIGHT, REFERENCE_HEIGHT, SIGMA

PAGE = (Path(__file__).parents[2] / "docs" / "road-prior-model.md").read_text(encoding="utf-8")
TEXT = re.sub(r"^```.*?^```$", "", PAGE, flags=re.M | re.S)
NAMES = sorted(set(re.findall(r"`([^`\n]+)`", TEXT)))
NUMBERS = re.findall(r"^\| `(floatref[\w.]+)` \| ([\d.e-]+) \|", PAGE, re.M)
CHANNELS = {DISTANCE, HEIGHT, REFERENCE_HEIGHT, SIGMA}


def found(name: str) -> Any:
    """Return what a dotted name leads to; ImportError or AttributeError if that is nothing."""
    module, rest = name, list[str]()
    while True:
        try:
            target = importlib.import_module(module)
            break
        except ModuleNotFoundError:
            module, _, last = module.rpartition(".")
            rest.insert(0, last)
            if not module:
                raise
    for part in rest:
        target = getattr(target, part)
    return target


@pytest.mark.parametrize("name", NAMES)
def test_every_name_is_one_of_the_code_or_a_setting_or_a_channel(name: str) -> None:
    if name.startswith("floatref"):
        assert found(name) is not None
    elif name.startswith("RoadPrior"):
        assert all(hasattr(RoadPrior, part) for part in name.split(".")[1:])
    else:
        assert name in CHANNELS | set(ROAD_PRIOR[0].settings)


def test_a_name_of_nothing_is_none() -> None:
    with pytest.raises(AttributeError):
        found("floatref_reference.road_prior.road.river")


@pytest.mark.parametrize(("name", "value"), NUMBERS)
def test_every_number_is_that_of_the_code(name: str, value: str) -> None:
    assert found(name) == float(value)


def test_every_setting_of_the_model_is_on_the_page() -> None:
    assert set(CONSTANTS) <= set(NAMES)
