"""Recordings and profiles on disk: `floatref-recording/1`, `floatref-profile/1` and CSV.

A directory holds one JSON file and raw little-endian float64 files beside it. Schemas are enforced
on reading and on writing; a directory is written completely or not at all.
"""

from floatref.files.apart.child_process import read_apart
from floatref.files.fingerprint import fingerprint, fingerprint_native
from floatref.files.mapped.mapped_files import map_bytes
from floatref.files.profile_csv import write_profile_csv
from floatref.files.profile_directory import read_profile, write_profile
from floatref.files.recording_directory import read_recording, write_recording
from floatref.files.schema import read_schema
from floatref.files.scratch import scratch_folder
from floatref.files.sources import check_file, open_bytes, read_bytes, read_start, real_path

__all__ = [
    "check_file",
    "fingerprint",
    "fingerprint_native",
    "map_bytes",
    "open_bytes",
    "read_apart",
    "read_bytes",
    "read_profile",
    "read_recording",
    "read_schema",
    "read_start",
    "real_path",
    "scratch_folder",
    "write_profile",
    "write_profile_csv",
    "write_recording",
]
