"""Headers as docs/erd.md found them with others: LTPP's text, CarSim's names and real numbers."""

import numpy as np
import pytest

from floatref import InputError
from floatref_adapters.formats.erd.erd_header import parse_header
from floatref_adapters.formats.erd.erd_profile import Erd

LTPP = """ERDFILEV2.00
      3,      4,     -1,      1,      5,       0.0250,     -1,
TITLE   LTPP SPS Section 06B410SF: Run 1
UNITSNAMmm      mm      mm
XUNITS  m
 Section No:  06B410
DATE    11/Apr/1997

END
 1.25 -0.5 0.0
 1.50 -0.5 0.0
 1.75 -0.5 0.0
 2.00 -0.5 0.0
"""


def test_the_text_of_ltpp(tmp_path):
    path = tmp_path / "run.txt"
    path.write_text(LTPP)
    profile = Erd().read(path)
    assert (profile.interval_m, profile.start_m) == (0.025, 0.0)
    assert [t.name for t in profile.tracks] == ["channel 1", "channel 2", "channel 3"]
    assert profile.tracks[0].elevation.tolist() == [0.00125, 0.0015, 0.00175, 0.002]
    assert profile.provenance["erd"]["title"] == "LTPP SPS Section 06B410SF: Run 1"


def carsim(count, unit="m", x="m"):
    """Return a header like CarSim's: names at the right of 32 characters, 31 of them in a line."""
    long = [f"Ground Z coord under tire {k}" for k in range(count)]
    first = "".join(f"{name:>32}" for name in long[:31])
    rest = "".join(f"{name:>32}" for name in long[31:])
    return "\n".join(
        [
            "ERDFILEV2.00",
            f"{count}, -1, -1, {4 * count}, 1, 0.025000",
            "TITLE   A run <of a vehicle>",
            "Category Restore",
            "SHORTNAM" + "".join(f"Zgnd_{k:<3}" for k in range(count)),
            f"LONGNAME{first}",
            f"&1000   {rest}",
            "UNITSNAM" + f"{unit:8}" * (count - 1) + f"{'deg':8}",
            "HISTORY CarSim",
            "XLABEL  Distance",
            f"XUNITS  {x}",
            "XSTART  3.000000",
            "HISTORY Run made at 16:49",
            "END",
            "",
        ]
    )


def test_the_names_of_carsim_and_reals_beside_them(tmp_path):
    header = parse_header(carsim(40).encode())
    assert header.channels[30].long == "Ground Z coord under tire 30"
    assert header.channels[31].long == "Ground Z coord under tire 31"
    assert header.channels[39].unit == "deg"
    assert header.history == ("CarSim", "Run made at 16:49")
    (tmp_path / "LastRun.erd").write_text(carsim(40))
    numbers = np.arange(3 * 40, dtype="<f4").reshape(3, 40) / 64
    numbers.tofile(tmp_path / "LastRun.bin")
    profile = Erd().read(tmp_path / "LastRun.erd")
    assert (profile.interval_m, profile.start_m) == (0.025, 3.0)
    assert len(profile.tracks) == 39
    np.testing.assert_array_equal(profile.track("Zgnd_7").elevation, numbers[:, 7])


def test_a_run_over_time_is_no_profile(tmp_path):
    (tmp_path / "LastRun.erd").write_text(carsim(40, x="s"))
    with pytest.raises(InputError, match="XUNITS is 's'; a profile needs the unit of its step"):
        Erd().read(tmp_path / "LastRun.erd")
