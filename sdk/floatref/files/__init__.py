"""Recordings and profiles on disk: `floatref-recording/1`, `floatref-profile/1` and CSV.

A directory holds one JSON file and raw little-endian float64 files beside it. Schemas are enforced
on reading and on writing; a directory is written completely or not at all.
"""

from floatref.files.fingerprint import fingerprint, fingerprint_native
from floatref.files.profile_csv import write_profile_csv
from floatref.files.profile_directory import read_profile, write_profile
from floatref.files.recording_directory import read_recording, write_recording
from floatref.files.schema import read_schema

__all__ = [
    "fingerprint",
    "fingerprint_native",
    "read_profile",
    "read_recording",
    "read_schema",
    "write_profile",
    "write_profile_csv",
    "write_recording",
]
