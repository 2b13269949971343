"""The vectors are those of the mutants, on the probes of this version."""

import random

import pytest

from floatref_conformance.devices import builtin
from floatref_conformance.devices.interface import Description
from floatref_conformance.mutants import MUTATIONS
from floatref_conformance.mutants.device import entries, make
from floatref_conformance.mutants.hostile import HOSTILE
from floatref_conformance.mutants.in_streams import STREAM_MUTANTS
from floatref_conformance.resemblance.catalogue import (
    GOOD,
    find_nearest,
    rank_flaws,
    read_vectors,
    write_vectors,
)
from floatref_conformance.resemblance.comparing import LEAST, MOST_FLAWS
from floatref_conformance.resemblance.making import measure_device
from floatref_conformance.resemblance.reviewing import REMADE

NOMINAL = Description("a", "1", "temporal", ())


def test_every_flaw_has_its_vector_or_its_fault():
    measured = {flaw.mutant for flaw in read_vectors().flaws}
    assert measured == {mutation.name for mutation in MUTATIONS}
    others = {each.name for each in (*HOSTILE, *STREAM_MUTANTS)}
    assert measured | others == {entry.name for entry in entries()}
    assert set(read_vectors().good) == {name for kind in GOOD.values() for name in kind}


def test_vectors_are_written_as_they_are_read():
    vectors = read_vectors()
    again = write_vectors(vectors)
    assert again.count("\n") > len(vectors.flaws)
    for flaw in vectors.flaws:
        assert all(abs(x) < 40 for x in flaw.features.values() if x is not None), flaw.mutant


@pytest.mark.parametrize("name", [name for kind in GOOD.values() for name in kind])
def test_a_good_device_resembles_no_flaw(name):
    architecture = "response" if name.startswith("response") else "temporal"
    able = ("imu", "gnss", "response")
    known = Description(name, "1", architecture, able)
    assert find_nearest(read_vectors().good[name], known) == ()


def test_only_flaws_that_the_device_can_have_are_compared():
    flaw = next(f for f in read_vectors().flaws if f.mutant == "late-laser")
    ranked = rank_flaws(flaw.features, NOMINAL, read_vectors())
    needs = {f.mutant: f.needs for f in read_vectors().flaws}
    assert ranked
    assert all(needs[one.mutant] == () for one in ranked)
    nearest = find_nearest(flaw.features, NOMINAL)
    assert len(nearest) <= MOST_FLAWS
    assert all(one.alike >= LEAST for one in nearest)
    assert [one.alike for one in ranked] == sorted((o.alike for o in ranked), reverse=True)


@pytest.mark.slow
def test_drawn_mutants_and_the_recommended_pipeline_have_the_stored_vectors():
    """The measurement again; two of the mutants, drawn anew each time."""
    nominal = [flaw for flaw in read_vectors().flaws if not flaw.needs]
    drawn = {f.mutant: f.features for f in random.sample(nominal, 2)}
    devices = {name: make(name) for name in drawn}
    first = GOOD["height"][0]
    devices[first], drawn[first] = builtin.make(first), read_vectors().good[first]
    for name, device in devices.items():
        _, features = measure_device(device)
        stored = {n: x for n, x in drawn[name].items() if n in features}
        for feature, value in features.items():
            assert value == pytest.approx(stored[feature], abs=REMADE), (name, feature)
