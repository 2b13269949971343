"""The IRI of elevations in m, one per line, by ctypes: python iri.py INTERVAL_M < FILE."""

import ctypes
import sys
from ctypes import POINTER, byref, c_double, c_int32, c_size_t, c_void_p
from pathlib import Path

lib = ctypes.CDLL(str(Path("libfloatref.so").resolve()))


class Config(ctypes.Structure):
    """fr_iri_config."""

    _fields_ = [
        (name, c_double)
        for name in ("interval_m", "moving_average_m", "start_length_m", "speed_kmh")
    ]


def declare(name, result, *arguments):
    """Name the types of a function: without them ctypes takes every pointer for an int."""
    function = getattr(lib, name)
    function.restype, function.argtypes = result, arguments


doubles, sizes = POINTER(c_double), POINTER(c_size_t)
declare("fr_status_text", ctypes.c_char_p, c_int32)
declare("fr_real_size", c_size_t)
declare("fr_iri_defaults", Config)
declare("fr_iri_size", c_size_t, POINTER(Config))
declare("fr_iri_init", c_int32, c_void_p, c_size_t, POINTER(Config), POINTER(c_void_p))
declare("fr_iri_push", c_int32, c_void_p, doubles, c_size_t, doubles, c_size_t, sizes)
declare("fr_iri_finish", c_int32, c_void_p, doubles, c_size_t, sizes)
declare("fr_iri_value", c_int32, c_void_p, doubles)


def check(status):
    """End the program with the line of the library if a call was refused."""
    if status != 0:
        sys.exit(lib.fr_status_text(status).decode())


def main():
    """Read elevations and print their IRI."""
    if lib.fr_real_size() != ctypes.sizeof(c_double):
        sys.exit("libfloatref.so is of single precision; build it without FR_FLOAT")
    config = lib.fr_iri_defaults()
    config.interval_m = float(sys.argv[1])
    values = [float(line) for line in sys.stdin]
    elevation, trace = (c_double * len(values))(*values), (c_double * len(values))()
    # Kept as long as the object, which lies in it.
    size = lib.fr_iri_size(byref(config))
    memory, iri = (ctypes.c_uint64 * (size // 8 + 1))(), c_void_p()
    written, m_per_km = c_size_t(), c_double()
    check(lib.fr_iri_init(memory, ctypes.sizeof(memory), byref(config), byref(iri)))
    check(lib.fr_iri_push(iri, elevation, len(values), trace, len(values), byref(written)))
    check(lib.fr_iri_finish(iri, trace, len(values), byref(written)))
    check(lib.fr_iri_value(iri, byref(m_per_km)))
    print(f"IRI {m_per_km.value:.3f} m/km")


if __name__ == "__main__":
    main()
