"""Formats whose layout is not public are refused with what is missing, out and in."""

import pytest

from floatref.engine.formats import format_of, profile_of
from floatref.errors import InputError
from floatref.files.withheld_formats import WITHHELD


@pytest.mark.parametrize("suffix", sorted(WITHHELD))
@pytest.mark.parametrize("case", [str.lower, str.upper])
def test_writing_and_reading_say_what_is_missing_and_what_to_do(tmp_path, suffix, case):
    path = tmp_path / f"run{case(suffix)}"
    with pytest.raises(InputError, match=r"is not supported: .*; write ERD, open it in ProVAL"):
        format_of(path)
    path.write_bytes(b"whatever, the layout is not known")
    with pytest.raises(InputError, match=r"is not supported: .*; open it in ProVAL and export"):
        profile_of(path)


def test_a_file_of_a_known_format_is_read_whatever_its_suffix(tmp_path):
    path = tmp_path / "run.pro"
    path.write_text("distance_m,left_elevation_m\n0,0.5\n1,0.25\n")
    assert profile_of(path).tracks[0].elevation.tolist() == [0.5, 0.25]


def test_a_name_chosen_by_hand_is_used(tmp_path):
    assert format_of(tmp_path / "run.pro", "csv").name == "csv"
