"""Sections of a fixed lag have so many nodes, and a standstill is one of them."""

from floatref_reference.road_prior.lag_sections import divide


def test_sections_have_so_many_nodes_and_a_standstill_is_one():
    points = [*range(12), *[12] * 20, *range(13, 33)]
    found = divide(points, 8, 4)
    assert found.ends[0] == 7
    first = found.composed.index(True)
    # The node that brings the twelfth point is followed by four without, and then by the record.
    assert first == 12 + 4 + 1
    assert found.composed[first:32] == [True] * (32 - first)
    nodes = [k for k, one in enumerate(found.composed) if not one or k == first]
    assert [nodes.index(end) % 8 for end in found.ends] == [7] * len(found.ends)
