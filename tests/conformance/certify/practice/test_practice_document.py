"""Practices as files: ours hold what they always held, an agency's is refused by its field."""

import json
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.files.schema import enforce_schema
from floatref_conformance.certify.judging.limits import CertificationLimits, limits_of
from floatref_conformance.certify.practice.practice_document import (
    DEFAULT,
    find_practice,
    list_names,
    read_own,
)
from floatref_conformance.certify.practice.requirements import UNITS
from floatref_conformance.classes import DeviceClass
from floatref_conformance.schemas import read_schema

SCHEMA = read_schema("conformance-practice-1")
LIMIT = {
    "quantity": "distance_percent",
    "limit": 0.2,
    "unit": "%",
    "clause": "our rule 7",
    "source": {"document": "our handbook"},
}
OURS = {
    "format": "conformance-practice/1",
    "name": "ours",
    "title": "Our practice",
    "version": "2026",
    "limits": [LIMIT],
}
METRES = {"m": 1.0, "mm": 0.001, "in": 0.0254, "ft": 0.3048}


def written(folder: Path, **changes: Any) -> str:
    path = folder / "mine.json"
    path.write_text(json.dumps({**OURS, **changes}), encoding="utf-8")
    return str(path)


def test_the_default_decides_as_it_always_did() -> None:
    nominal = (10, 0.92, 0.90, 0.15, 1.0, None, 5.0, 0.047, 0.126, None)
    adequate = (10, 0.95, 0.92, 0.15, 1.0, 5.0, 5.0, 0.047, 0.126, None)
    reference = (10, 0.98, 0.98, 0.15, 1.0, 2.0, 5.0, 0.0235, 0.063, None)
    for device_class, limits in zip(DeviceClass, (nominal, adequate, reference), strict=True):
        assert tuple(limits_of(device_class).figures().values()) == limits
    assert CertificationLimits() == limits_of(DeviceClass.NOMINAL)
    assert not read_own(DEFAULT).open_requirements()


@pytest.mark.parametrize("name", list_names())
def test_our_own_keep_the_schema_and_name_a_source_or_what_was_not_had(name: str) -> None:
    practice = find_practice(name)
    folder = Path(__file__).parents[4] / "conformance/floatref_conformance/certify/practice/data"
    content = (folder / f"{name}.json").read_bytes()
    enforce_schema(json.loads(content), SCHEMA, name)
    assert practice.name == name
    assert practice.sha256 == sha256(content).hexdigest()
    for one in practice.requirements:
        assert one.limit is None or one.basis != "agency", one
        assert one.limit is not None or one.word == "reported" or one.missing, one
        assert one.quantity in UNITS
    for device_class in DeviceClass:
        named = [one.quantity for one in practice.of_class(device_class).requirements]
        assert len(named) == len(set(named)), device_class


def test_schema_and_code_know_the_same_quantities() -> None:
    known = SCHEMA["$defs"]["limit"]["properties"]["quantity"]["enum"]
    assert known == list(UNITS)


@given(limit=st.floats(1e-6, 1e4), unit=st.sampled_from(sorted(METRES)))
def test_a_limit_is_the_same_length_in_every_unit(
    tmp_path_factory: pytest.TempPathFactory, limit: float, unit: str
) -> None:
    entry = {**LIMIT, "quantity": "interval_m", "limit": limit, "unit": unit}
    path = written(tmp_path_factory.mktemp("unit"), limits=[entry])
    found = find_practice(path).limit_of("interval_m")
    assert found == pytest.approx(limit * METRES[unit], rel=1e-9, abs=1e-11)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"limits": []}, "limits is a list of 0"),
        ({"title": 3}, "title is 3"),
        ({"limts": []}, 'unknown key "limts"'),
        ({"format": "conformance-practice/9"}, "format"),
        ({"name": DEFAULT}, "a practice of ours"),
        ({"limits": [{**LIMIT, "quantity": "distance"}]}, "limits[0].quantity"),
        ({"limits": [{**LIMIT, "limit": "secret"}]}, "limits[0].limit"),
        ({"limits": [{**LIMIT, "limit": -1}]}, "limits[0].limit"),
        ({"limits": [{**LIMIT, "unit": "m"}]}, "limits[0] (distance_percent): unit is 'm'"),
        ({"limits": [{**LIMIT, "source": {}}]}, "limits[0].source has no document"),
        ({"limits": [LIMIT, LIMIT]}, "distance_percent has two limits in class nominal"),
        ({"limits": [{**LIMIT, "quantity": "accuracy", "limit": 92, "unit": ""}]}, "from 0 to 1"),
        ({"limits": [{**LIMIT, "quantity": "accuracy", "limit": 0, "unit": ""}]}, "reach 0"),
        ({"limits": [{**LIMIT, "quantity": "interval_m", "limit": 0, "unit": "m"}]}, "above 0"),
        ({"name": "county\n"}, "name is"),
        ({"limits": [{**LIMIT, "limit": "reported\n"}]}, "limits[0].limit"),
        ({"limits": [{**LIMIT, "quantity": "runs", "limit": 2.5, "unit": ""}]}, "whole number"),
    ],
)
def test_what_is_no_practice_is_one_line_that_names_the_field(
    tmp_path: Path, changes: dict[str, Any], said: str
) -> None:
    with pytest.raises(InputError) as caught:
        find_practice(written(tmp_path, **changes))
    line = str(caught.value)
    assert said in line
    assert "mine.json" in line
    assert "\n" not in line


HIDDEN = ("\ud800", "\x1b]0;x\x07", "\u202e", "\n", "\x85", "\u2028", "\x00")
PLACES = ("title", "version", "status", "notes", "clause", "missing", "document", "section", "url")


@given(st.text(st.characters(exclude_categories=("Cc", "Cs", "Cn", "Co"))), st.data())
def test_a_text_that_one_line_cannot_show_is_refused_wherever_it_is(
    tmp_path_factory: pytest.TempPathFactory, before: str, data: st.DataObject
) -> None:
    place, hidden = data.draw(st.sampled_from(PLACES)), data.draw(st.sampled_from(HIDDEN))
    text = f"https://{before[:20]}{hidden}x"
    changes: dict[str, Any] = {place: [text] if place == "notes" else text}
    if place in ("document", "section", "url"):
        changes = {"limits": [{**LIMIT, "source": {"document": "a", place: text}}]}
    elif place in ("clause", "missing"):
        changes = {"limits": [{**LIMIT, place: text}]}
    with pytest.raises(InputError, match=place) as caught:
        find_practice(written(tmp_path_factory.mktemp("text"), **changes))
    assert str(caught.value).isprintable()


def test_a_limit_that_is_given_twice_is_refused(tmp_path: Path) -> None:
    path = Path(written(tmp_path))
    text = path.read_text("utf-8")
    path.write_text(text.replace('"limit": 0.2', '"limit": 0.2, "limit": 5'), "utf-8")
    with pytest.raises(InputError, match=r'mine\.json: has the key "limit" twice'):
        find_practice(str(path))


@pytest.mark.parametrize("content", [b"", b"{", b"[1]", b"\xff\xfe"])
def test_what_is_no_json_object_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "mine.json"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"mine\.json"):
        find_practice(str(path))
