"""One file: read, processed, written, measured; its record is written last."""

import os
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from time import perf_counter, process_time

from floatref.batch.jobs.job import Job
from floatref.batch.results.positions import is_located
from floatref.batch.results.record import Effort, Record, make_folder_of, read_record, write_record
from floatref.batch.results.segments import measure_segments
from floatref.batch.work.unchanged import check_unchanged, holds, list_what_matters, stamps_of
from floatref.engine.plugins import plugins
from floatref.errors import FloatrefError, one_line
from floatref.files import fingerprint_native, read_profile, write_profile
from floatref.files.atomic import SAMPLE_SUFFIXES
from floatref.files.profile_directory import DOCUMENT
from floatref.mapping.sources import make_profile, recording_of
from floatref.values.recording import Recording


class Watch:
    """Measures from when it is made."""

    def __init__(self) -> None:
        """Start to measure."""
        self._seconds, self._cpu_s = perf_counter(), _cpu_s()

    def complete(self, record: Record, job: Job) -> Record:
        """Return ``record`` with its effort until now."""
        effort = Effort(
            seconds=perf_counter() - self._seconds,
            cpu_s=_cpu_s() - self._cpu_s,
            bytes_in=_bytes(map(Path, record.inputs)),
            bytes_out=_bytes(job.profile / name for name in record.outputs),
            peak_bytes=peak_bytes(),
        )
        return replace(record, effort=effort)


def peak_bytes() -> int:
    """Return the largest resident memory of this process until now; 0 where it is not counted."""
    if sys.platform == "win32":
        return 0
    with suppress(OSError):
        # What getrusage counts begins with the memory of the process that started this one.
        found = re.search(
            r"^VmHWM:\s*(\d+)", Path("/proc/self/status").read_text(encoding="ascii"), re.MULTILINE
        )
        if found:
            return int(found[1]) << 10
    import resource

    largest = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return largest if sys.platform == "darwin" else largest << 10


def _cpu_s() -> float:
    """Return the processor time in s of this process, and of those that it has started."""
    spent = os.times()
    return process_time() + spent.children_user + spent.children_system


def _bytes(paths: Iterable[Path]) -> int:
    total = 0
    for path in paths:
        with suppress(OSError):
            total += os.stat(path).st_size
    return total


def run_job(job: Job, resume: bool = False) -> Record:
    """Return the record of ``job``; its profile and its record are written.

    With ``resume`` nothing is processed if the existing profile was made of the same bytes in the
    same way; rows are measured again for other segments or measures. Never raises an Exception: any
    error is stored in the record, and the profile of an earlier run is removed.
    """
    with _reports_apart():
        old = read_valid_record(job) if resume else None
        return _work(job) if old is None else old


def record_failure(job: Job, reason: str) -> Record:
    """Return the record of ``job`` with the reason why it has no profile."""
    return Record(job.name, str(job.source), error=one_line(reason), key=_key(job))


def _key(job: Job) -> dict[str, object]:
    return {"asked": list_what_matters(job), **_measured(job)}


def _measured(job: Job) -> dict[str, object]:
    """Return what the rows of ``job`` are asked to have; the profile does not depend on it."""
    return {"segment_m": job.segment_m, "measured": ["lines", *(["ride"] if job.measures else [])]}


@contextmanager
def _reports_apart() -> Iterator[None]:
    """Keep the warnings of plug-ins on one file out of the warnings of the next."""
    reports = plugins().reports
    count = len(reports)
    try:
        yield
    finally:
        del reports[count:]


def read_valid_record(job: Job) -> Record | None:
    """Return the existing record of ``job`` if it is still valid; None if it must be redone."""
    try:
        old = read_record(job.record)
        if not holds(old, job):
            return None
        if any(old.key.get(name) != value for name, value in _measured(job).items()):
            old = _measure_again(old, job)
            write_record(old, job.record)
    except Exception:
        # New files replace the old ones, whatever their fault is.
        return None
    return replace(old, skipped=True)


def _measure_again(old: Record, job: Job) -> Record:
    """Return ``old`` with the rows of its profile for other segments or other measures."""
    recording = _recording(job) if old.key["located"] else None
    rows, remarks = measure_segments(
        read_profile(job.profile), job.segment_m, recording, job.measures
    )
    key = {**old.key, **_measured(job)}
    return replace(old, rows=rows, remarks=remarks, key=key)


def _recording(job: Job) -> Recording:
    return recording_of(job.source, job.adapter, job.channel_map).recording


def _work(job: Job) -> Record:
    watch = Watch()
    try:
        record = watch.complete(_make_profile(job), job)
        write_record(record, job.record)
    except (Exception, SystemExit) as error:
        record = watch.complete(record_failure(job, _reason(error)), job)
        _remove(job.profile)
        with suppress(FloatrefError, OSError):
            write_record(record, job.record)
    return record


def _make_profile(job: Job) -> Record:
    """Write the profile of ``job``; return its record without the effort."""
    before = stamps_of(job)
    read = recording_of(job.source, job.adapter, job.channel_map)
    result = make_profile(read, job.pipeline, job.settings)
    profile = result.profile
    rows, remarks = measure_segments(profile, job.segment_m, read.recording, job.measures)
    check_unchanged(before, read.inputs)
    _make_room(job.profile)
    write_profile(profile, job.profile, overwrite=True)
    more = {
        "pipeline": profile.pipeline,
        "chosen": profile.provenance.get("chosen", {}).get("reason"),
        "settings": dict(profile.settings),
        "adapter": read.origin["adapter"],
        "located": is_located(read.recording),
    }
    return Record(
        name=job.name,
        source=str(job.source),
        rows=rows,
        warnings=result.warnings,
        remarks=remarks,
        key={**_key(job), **more},
        inputs={str(path): value for path, value in read.inputs.items()},
        outputs=fingerprint_native(job.profile),
        length_m=profile.length_m,
    )


def _reason(error: BaseException) -> str:
    """Return ``error`` in one line."""
    text = " ".join(str(error).split())
    if isinstance(error, FloatrefError):
        return text
    if isinstance(error, MemoryError):
        return "not enough memory; give each worker more, or cut the run into shorter ones"
    if isinstance(error, OSError):
        place = f"{error.filename}: " if error.filename else ""
        return f"{place}{error.strerror or text}"
    return f"a fault of floatref or of a plug-in: {type(error).__name__}: {text}"


def _make_room(profile: Path) -> None:
    """Make the folder around ``profile``, and remove the remains of an older one."""
    make_folder_of(profile)
    if not (profile / DOCUMENT).exists():
        _remove(profile)


def _remove(profile: Path) -> None:
    """Remove the files of a profile directory, its mandatory file first."""
    with suppress(OSError):
        (profile / DOCUMENT).unlink(missing_ok=True)
        for path in profile.iterdir():
            if path.name.endswith(SAMPLE_SUFFIXES):
                path.unlink()
        os.rmdir(profile)
