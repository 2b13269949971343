"""The page on extending: its examples run, and it names every hook."""

import re
from fractions import Fraction
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from floatref import Channel, InputError, Profile, ProfileTrack, Recording, Stage, UniformClock
from floatref.engine.plugins import Plugins
from floatref.interfaces import hookspecs
from floatref.interfaces.drop_out import DropOut
from floatref.interfaces.pipeline import Context
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref_conformance import hookspecs as conformance_hookspecs
from floatref_reference.appendix_a.filters import hpf_b3s1

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "extending.md").read_text(encoding="utf-8")
ELEVATION = ChannelId("elevation", "main")


@pytest.fixture(scope="module")
def example() -> ModuleType:
    """Return a module made of all Python examples of the page."""
    module = ModuleType("my_profiler")
    for code in re.findall(r"^```python\n(.*?)^```$", PAGE, re.M | re.S):
        exec(code, vars(module))
    return module


@pytest.fixture
def plugins(example: ModuleType) -> Plugins:
    """Return the built-in plug-ins and the example."""
    loaded = Plugins()
    loaded.add(example, "my_profiler")
    return loaded


@pytest.mark.parametrize("specs", [hookspecs, conformance_hookspecs], ids=["sdk", "judge"])
def test_every_hook_is_on_the_page(specs: ModuleType) -> None:
    marks = ("floatref_spec", "floatref_conformance_spec")
    hooks = [n for n, f in vars(specs).items() if any(hasattr(f, mark) for mark in marks)]
    assert hooks
    for hook in hooks:
        assert f"`{hook}`" in PAGE, hook


def test_every_point_is_in_the_signal_flows_of_the_architecture_page() -> None:
    page = (DOCS / "architecture.md").read_text(encoding="utf-8")
    points = [n for n in vars(hookspecs) if n.startswith(("temporal_", "spatial_"))]
    assert re.findall(r"^\| `((?:temporal|spatial)_\w+)` \|", page, re.M) == points


def stages_at(plugins: Plugins, name: str, point: str) -> list[Stage]:
    header = Header(Axis.TIME, 1e-3, 0.0, Fraction(1000), frozenset({ELEVATION}), tracks=("main",))
    pipeline = plugins.pipeline(name)
    return list(plugins.ask(Context(point, pipeline, pipeline.resolve({}), header, origin_m=0.0)))


def test_the_point_is_answered_in_the_pipelines_that_are_named(plugins: Plugins) -> None:
    for name in ("temporal-basic", "temporal-mean-removal"):
        cutoffs = [stage.cutoff for stage in stages_at(plugins, name, "temporal_finish")]
        assert cutoffs == 4 * [1 / 60.0]
    others = stages_at(plugins, "kalman-smoother", "temporal_finish")
    assert {stage.cutoff for stage in others} == {1 / 105.91}
    assert plugins.reports == []


def test_the_pipelines_are_known_and_bring_their_answers(plugins: Plugins) -> None:
    first, second = stages_at(plugins, "my-profiler", "temporal_first_integration")
    assert (first.cutoff, second.name) == (0.05, "Integrate")
    assert stages_at(plugins, "my-profiler", "temporal_finish") == []
    stages = stages_at(plugins, "my-smoother", "temporal_finish")
    assert [stage.cutoff for stage in stages] == 4 * [1 / 105.91] + 2 * [1 / 60.0]


def test_a_gap_of_the_heights_is_answered_from_what_was_recorded(example: ModuleType) -> None:
    profile = Profile(0.025, (ProfileTrack.of("main", np.zeros(9), np.ones(9, np.bool_)),))
    asked: list[str] = []

    def process(pipeline: str, settings: object = None) -> Profile:
        asked.append(pipeline)
        return profile

    clock, samples = UniformClock.of(1000), np.zeros(9)
    for name, answer in (("height", None), ("unsprung_specific_force", profile)):
        recording = Recording((Channel.of(name, samples, clock),))
        gaps = {"main": np.array([[1.0, 2.0]])}
        found = example.temporal_fall_back(DropOut(recording, profile, gaps, process))
        assert found is answer, name
    assert asked == ["response-observer"]


def test_the_stage_is_known_and_scales(plugins: Plugins) -> None:
    stage = plugins.stages()["Scale"](3.0)
    stage.start(Header(Axis.DISTANCE, 0.1, 0.0, Fraction(1000), frozenset({ELEVATION}), ("main",)))
    out = stage.push(Block(0, {ELEVATION: np.array([1.0, -2.0])}))
    np.testing.assert_array_equal(out[ELEVATION], [3.0, -6.0])


def test_the_stage_taken_by_hand_is_the_filter_of_the_reference(example: ModuleType) -> None:
    expected = hpf_b3s1(example.samples, 0.0422, 1 / 16_000)
    np.testing.assert_allclose(np.concatenate(example.filtered), expected, rtol=0, atol=1e-12)


def test_the_adapter_reads_its_format(plugins: Plugins, tmp_path: Path) -> None:
    adapter = plugins.adapters()["my-format"]
    path = tmp_path / "run.mine"
    np.array([[1, 300, 0], [1, 301, 0.01]], "<f4").tofile(path)
    assert adapter.recognises(path)
    height = adapter.read(path).channel("height")
    np.testing.assert_allclose(height.values, [0.3, 0.301], rtol=1e-6)
    path.write_bytes(b"1234")
    with pytest.raises(InputError, match="no triples"):
        adapter.read(path)


def test_the_profile_format_writes_and_reads_what_it_can_hold(
    plugins: Plugins, tmp_path: Path
) -> None:
    form = plugins.profile_formats()["bump"]
    path, profile = tmp_path / "run.bump", Profile(0.1, (ProfileTrack.of("main", [0.001, -0.002]),))
    form.write(profile, path)
    assert form.recognises(path)
    back = form.read(path)
    assert back.interval_m == 0.1
    np.testing.assert_allclose(back.tracks[0].elevation, [0.001, -0.002], rtol=1e-12)
    with pytest.raises(InputError, match="all valid"):
        form.write(Profile(0.1, (ProfileTrack.of("main", [0.0, np.nan]),)), path)
    path.write_text("BUMP 0.1 x")
    with pytest.raises(InputError, match=r"run\.bump: could not convert"):
        form.read(path)


def test_the_device_describes_itself(example: ModuleType) -> None:
    from floatref_conformance.devices.interface import Description, DeviceKind

    kinds: list[DeviceKind] = []
    example.conformance_register_devices(kinds.append)
    device = kinds[0].make("one")
    assert kinds[0].usage == "mine:MODEL"
    assert Description.of(device.describe()).name == "one"
