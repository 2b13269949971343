"""A limit that replaces one of the practice is named as that, and judges what the practice left."""

from hypothesis import given
from hypothesis import strategies as st

from floatref_conformance.certify.judging.asked import list_open
from floatref_conformance.certify.judging.limits import LIMITED, change_limits, limits_of
from floatref_conformance.certify.practice.practice_document import find_practice, list_names
from floatref_conformance.certify.worksheet.wording import practice_in_words
from floatref_conformance.classes import DeviceClass
from floatref_conformance.cli.certify.certify_options import OPTIONS, limits_with
from floatref_conformance.cli.certify.command import certify

GIVEN = st.dictionaries(st.sampled_from(sorted(OPTIONS)), st.sampled_from((None, 0.25, 0.90, 10)))


@given(st.sampled_from(list_names()), GIVEN)
def test_changed_is_exactly_what_differs_from_the_practice(
    name: str, changes: dict[str, float | None]
) -> None:
    own = limits_of(DeviceClass.NOMINAL, find_practice(name))
    made = change_limits(own, changes, OPTIONS)
    differing = {one for one in LIMITED if made.figures()[one] != own.figures()[one]}
    assert set(made.practice.changed) == differing
    assert made.practice.sha256 == own.practice.sha256
    for one in LIMITED:
        assert made.practice.limit_of(one) == made.figures()[one]
        if one in differing:
            assert made.clause(one).startswith(f"set by {OPTIONS[one]}; the practice has: ")
        else:
            assert made.clause(one) == own.clause(one)
    still = {one.quantity for one in own.practice.open_requirements()} - differing
    assert {one.quantity for one in made.practice.open_requirements()} == still


def test_all_that_a_practice_leaves_open_can_be_given() -> None:
    practice = find_practice("nchrp-1057")
    asked = {one.quantity: 1.0 for one in practice.open_requirements()}
    limits = limits_with(DeviceClass.NOMINAL, asked, "nchrp-1057")
    assert not limits.practice.open_requirements()
    assert not list_open(limits)
    assert set(limits.practice.changed) == set(asked)


def test_the_clause_of_another_limit_has_the_practices_own() -> None:
    limits = limits_with(DeviceClass.NOMINAL, {"accuracy": 0.1})
    said = "set by --min-accuracy; the practice has: limit 0.9"
    assert limits.clause("accuracy") == said
    assert practice_in_words(limits)[-1] == ("Changed", f"accuracy: {said}")
    same = limits_with(DeviceClass.NOMINAL, {"accuracy": 0.9, "iri_bias_percent": "none"})
    assert same == limits_of(DeviceClass.NOMINAL)


def test_each_quantity_is_set_by_the_option_that_is_named() -> None:
    declared = {one.name: max(one.opts, key=len) for one in certify.params}
    found = {one: declared.get(one) for one in OPTIONS} | {"runs": declared["least_runs"]}
    assert found == OPTIONS
