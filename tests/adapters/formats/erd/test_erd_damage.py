"""A damaged ERD file is a profile, or one clear line."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import InputError
from floatref_adapters.formats.erd.erd_profile import Erd

WHOLE = b"""ERDFILEV2.00
2, 3, -1, 1, 5, 0.5, -1,
SHORTNAMLElev.  RElev.
UNITSNAMin      in
XUNITS  ft
LONGNAMEleft elevation
END
0.25 -0
1.25 -1
2.25 -2
"""


@pytest.mark.slow
@settings(deadline=None, max_examples=300)
@given(place=st.integers(0, 400), junk=st.binary(max_size=12), cut=st.integers(0, 12))
def test_damage_anywhere_is_a_profile_or_one_clear_line(tmp_path_factory, place, junk, cut):
    path = tmp_path_factory.getbasetemp() / "damaged.erd"
    path.write_bytes(WHOLE[:place] + junk + WHOLE[place + cut :])
    refusals = []
    try:
        assert Erd().read(path).tracks[0].elevation.size >= 1
    except InputError as error:
        refusals.append(str(error))
    assert all(line.isprintable() for line in refusals)
