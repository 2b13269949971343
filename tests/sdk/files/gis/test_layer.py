"""Layers: both formats hold the same features, RFC 7946 is kept, and failures leave nothing."""

import json
import sys

import numpy as np
import pyogrio
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.files.gis.layer import check_layer, write_layer

COLUMNS = {"name": str, "segment": int, "iri": float, "marked": bool, "rating": str}
angles = st.integers(-1_790_000_000, 1_790_000_000).map(lambda n: n / 1e7)
places = st.tuples(angles, angles.map(lambda angle: angle / 2))
lines = st.lists(places, min_size=2, max_size=5).map(tuple)
properties = st.fixed_dictionaries(
    {
        "name": st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=8),
        "segment": st.integers(0, 2**40),
        "iri": st.floats(0, 100) | st.just(float("nan")) | st.none(),
        "marked": st.booleans(),
        "rating": st.sampled_from(["good", "fair", None]),
    }
)
features = st.lists(st.tuples(st.lists(lines, max_size=3).map(tuple), properties), max_size=8)


def written(folder, suffix, found):
    path = folder / f"layer{suffix}"
    count = write_layer(found, COLUMNS, path, overwrite=True)
    return path, count


@pytest.mark.slow
@settings(max_examples=60)
@given(found=features)
def test_geojson_has_every_feature_that_has_a_place(tmp_path_factory, found):
    path, count = written(tmp_path_factory.getbasetemp(), ".geojson", found)
    placed = [(shape, values) for shape, values in found if shape]
    assert (count.written, count.left_out) == (len(placed), len(found) - len(placed))
    collection = json.loads(path.read_text(encoding="utf-8"))
    assert set(collection) == {"type", "features"}
    assert collection["type"] == "FeatureCollection"
    for feature, (shape, values) in zip(collection["features"], placed, strict=True):
        assert list(feature["properties"]) == list(COLUMNS)
        for name, value in values.items():
            unknown = value is None or value != value
            assert feature["properties"][name] == (None if unknown else value)
        geometry = feature["geometry"]
        parts = [geometry["coordinates"]] if len(shape) == 1 else geometry["coordinates"]
        assert geometry["type"] == ("LineString" if len(shape) == 1 else "MultiLineString")
        assert [[tuple(place) for place in part] for part in parts] == [list(s) for s in shape]


@pytest.mark.slow
@settings(max_examples=15)
@given(found=features)
def test_a_geopackage_has_the_same_features_in_wgs_84(tmp_path_factory, found):
    path, count = written(tmp_path_factory.getbasetemp(), ".gpkg", found)
    info = pyogrio.read_info(path)
    assert (info["crs"], info["geometry_type"]) == ("EPSG:4326", "MultiLineString")
    assert (list(info["fields"]), info["features"]) == (list(COLUMNS), count.written)
    meta, _, shapes, columns = pyogrio.raw.read(path)
    placed = [(shape, values) for shape, values in found if shape]
    for shape, (expected, _) in zip(shapely.from_wkb(shapes), placed, strict=True):
        assert [tuple(part.coords) for part in shape.geoms] == list(expected)
    for name, column in zip(meta["fields"], columns, strict=True):
        for value, (_, values) in zip(column.tolist(), placed, strict=True):
            expected = values[name]
            unknown = expected is None or expected != expected
            assert (value is None or value != value) if unknown else value == expected


def test_more_features_than_are_held_at_once(tmp_path, monkeypatch):
    monkeypatch.setattr("floatref.files.gis.geopackage.TOGETHER", 2)
    found = [((((0.0, 1.0), (0.0, k)),), {"segment": k}) for k in range(5)]
    columns = {"segment": int}
    assert write_layer(found, columns, tmp_path / "x.gpkg").written == 5
    _, _, _, (segments,) = pyogrio.raw.read(tmp_path / "x.gpkg")
    np.testing.assert_array_equal(segments, range(5))


def test_what_is_left_out_is_counted_in_words(tmp_path):
    count = write_layer([((), {}), ((), {})], COLUMNS, tmp_path / "x.geojson")
    assert str(count) == "0 segments; 2 without a place are left out"


@pytest.mark.parametrize("suffix", [".geojson", ".gpkg"])
def test_a_failure_leaves_what_was_there(tmp_path, suffix):
    def failing():
        yield (((0.0, 1.0), (0.0, 2.0)),), {"name": "a", "segment": 0, "marked": False}
        raise InputError("the disk is gone")

    path = tmp_path / f"x{suffix}"
    path.write_text("before")
    with pytest.raises(InputError, match="the disk is gone"):
        write_layer(failing(), COLUMNS, path, overwrite=True)
    assert path.read_text() == "before"
    with pytest.raises(InputError, match="exists"):
        write_layer([], COLUMNS, path)
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("missing", ["pyogrio", "shapely"])
def test_a_missing_library_and_another_suffix_are_one_line(tmp_path, monkeypatch, missing):
    monkeypatch.setitem(sys.modules, missing, None)
    with pytest.raises(InputError, match=rf"needs {missing}; .*\[gis\]"):
        check_layer(tmp_path / "x.gpkg")
    check_layer(tmp_path / "x.geojson")
    with pytest.raises(InputError, match=r"suffix '\.shp' is no format of a layer; use \.geojson"):
        check_layer(tmp_path / "x.shp")
