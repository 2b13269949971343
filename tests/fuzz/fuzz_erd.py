"""Fuzz the ERD reader: any bytes are a profile, or one `InputError` of one line.

Run it as `harness` says. Numbers behind a byte 255 go to the `.bin` file beside the header, so that
real numbers are reached too. A profile that is read is written and read again, and has to be the
same then.
"""

from harness import fuzz, instrumented, one_line, scratch

with instrumented():
    from floatref import InputError, Profile
    from floatref_adapters.formats.erd.erd_profile import Erd

FOLDER = scratch("erd")
HEADER, NUMBERS, AGAIN = (FOLDER / name for name in ("a.erd", "a.bin", "b.erd"))
SEEDS = (
    b"ERDFILEV2.00\n2, 2, -1, 1, 5, 0.5, -1,\nSHORTNAMLElev   RElev   \nUNITSNAMin      mm      \n"
    b"XUNITS  ft\nXSTART  1.5\nEND\n1 2\n3 4\n",
    b"ERDFILEV2.00\r\n1,-1,-1,4,1,.1\r\nUNITSNAMm\r\nXUNITS  m\r\nEND\r\n\xff\x00\x00\x80?",
    b"ERDFILEV2.00\r2 1 -1 1 5 1D-1\rLONGNAMEleft elevation                  left valid\r"
    b"UNITSNAMm       -\r&1000   \rXUNITS  km\rHISTORY floatref-erd/1, x\rEND\r0.5,1\r",
)


def read_any(data: bytes) -> None:
    header, _, numbers = data.partition(b"\xff")
    HEADER.write_bytes(header)
    NUMBERS.write_bytes(numbers)
    Erd().recognises(HEADER)
    profile = one_line(Erd().read, HEADER)
    if profile is None:
        return
    try:
        Erd().write(profile, AGAIN)
    except InputError:
        return
    same(profile, Erd().read(AGAIN))


def same(profile: Profile, again: Profile) -> None:
    """Raise AssertionError unless ``again`` is ``profile`` to the written digits."""
    if (profile.interval_m, profile.start_m) != (again.interval_m, again.start_m):
        raise AssertionError("step or start changed")
    if len(profile.tracks) != len(again.tracks):
        raise AssertionError("number of tracks changed")
    for one, other in zip(profile.tracks, again.tracks, strict=True):
        if one.valid.tolist() != other.valid.tolist():
            raise AssertionError("validity changed")
        off = abs(one.elevation - other.elevation)[one.valid]
        if off.size and off.max() > 1e-7:
            raise AssertionError("elevation changed")


if __name__ == "__main__":
    fuzz("erd", read_any, SEEDS)
