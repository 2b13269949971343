"""A Dask cluster for one command: processes of this machine, or a cluster that runs elsewhere."""

import logging
import warnings
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from floatref.batch.work.encryption import check_encrypted
from floatref.batch.work.held_signals import hold_signals
from floatref.batch.work.limited_calls import call_within
from floatref.errors import InputError, missing_extra
from floatref.files.atomic import replace_file
from floatref.files.scratch import scratch_folder
from floatref.version import __version__

if TYPE_CHECKING:
    from distributed import Client, LocalCluster

ANSWER_S = 10.0
"""Longest time in s until a scheduler answers."""

WORKERS_S = 30.0
"""Longest time in s until a cluster has its first worker."""

START_S = 300.0
"""Longest time in s until the processes of this machine are ready to work."""

CLOSE_S = 60.0
"""Longest time in s until they have ended; those that have not then end with this process."""

LOCAL = {
    # One file per worker and no other waiting there: the file of a dead worker is the cause.
    "distributed.scheduler.worker-saturation": 1.0,
    # A file that has ended two workers is tried alone, which shows the cause.
    "distributed.scheduler.allowed-failures": 1,
    # A worker that reads or compiles for minutes does not answer, but works.
    "distributed.scheduler.worker-ttl": "24 hours",
    "distributed.worker.multiprocessing-method": "spawn",
    # Nothing of ours can be spilled; a paused worker would wait for ever.
    "distributed.worker.memory.target": False,
    "distributed.worker.memory.spill": False,
    "distributed.worker.memory.pause": False,
}
"""Dask's configuration for a local cluster."""

TEMPORARY = ("TMPDIR", "TEMP", "TMP")
"""Variables that name the folder for temporary files; Windows has the last two."""
LOGGERS = ("distributed", "tornado", "asyncio", "bokeh")


def check_installed() -> None:
    """Raise InputError now if a package for a batch is missing."""
    try:
        import cryptography  # noqa: F401  # Imported to see whether it is there, as the next three.
        import dask  # noqa: F401
        import distributed  # noqa: F401
        import pyarrow  # noqa: F401
    except ImportError as error:
        raise missing_extra("a batch needs Dask, cryptography and pyarrow", "batch") from error


@contextmanager
def connect(
    out: Path,
    jobs: int | None = None,
    address: str | None = None,
    unencrypted: bool = False,
) -> Iterator["Client"]:
    """Yield a client of the cluster at ``address``, or of ``jobs`` processes of this machine.

    Without both there is one process for each processor. Local processes speak TLS with a secret
    that only they have, and end with the context. Raises InputError for an ``address`` beyond this
    machine without TLS, unless that is allowed as ``unencrypted``, if no scheduler answers, if it
    has no workers, if one of them has another version of floatref, or does not see the folder
    ``out``.
    """
    check_installed()
    if address is not None:
        check_encrypted(address, unencrypted)
    with ExitStack() as stack:
        stack.enter_context(_quiet())
        client = stack.enter_context(_local(jobs) if address is None else _find_cluster(address))
        if address is not None:
            _check_workers(client, out)
        yield client


def count_workers(client: "Client") -> int:
    """Return the number of workers; 0 if the scheduler does not answer."""
    try:
        return len(call_within(client.nthreads, WORKERS_S))
    except (OSError, RuntimeError, TimeoutError):
        return 0


@contextmanager
def _quiet() -> Iterator[None]:
    """Suppress logs and warnings of the cluster; floatref prints its own messages."""
    import distributed  # noqa: F401  # It sets levels of its own when it is imported.

    for name in LOGGERS:
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


@contextmanager
def _local(jobs: int | None) -> Iterator["Client"]:
    import dask
    from distributed import Client

    with ExitStack() as stack:
        # Temporary files of a killed worker are removed with the command.
        scratch = str(stack.enter_context(scratch_folder("batch")))
        stack.enter_context(dask.config.set({**LOCAL, "temporary-directory": scratch}))
        try:
            with hold_signals():
                cluster = _start(jobs, scratch)
                stack.callback(_close, cluster)
                client = stack.enter_context(Client(cluster))
                stack.callback(_close, client)
        except (OSError, RuntimeError, TimeoutError) as error:
            raise InputError(f"no workers can be started here ({error}); try --jobs 1") from error
        yield client


def _start(jobs: int | None, scratch: str) -> "LocalCluster":
    from dask.system import CPU_COUNT
    from distributed import LocalCluster, Security

    return LocalCluster(
        n_workers=jobs or CPU_COUNT,
        processes=True,
        threads_per_worker=1,
        dashboard_address=None,
        protocol="tls://",
        # Without it every program of this machine could run its code in a worker.
        security=Security.temporary(),
        death_timeout=START_S,
        env=dict.fromkeys(TEMPORARY, scratch),
        silence_logs=logging.CRITICAL + 1,
    )


def _close(ending: "Client | LocalCluster") -> None:
    """Close a client or a cluster, with a limit: a worker may wait for what does not come."""
    with hold_signals(), suppress(TimeoutError):
        ending.close(timeout=CLOSE_S)


@contextmanager
def _find_cluster(address: str) -> Iterator["Client"]:
    from distributed import Client

    try:
        client = Client(address, timeout=ANSWER_S)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(
            f"cluster {address}: no scheduler answers there ({error}); start one, or leave "
            "--cluster out"
        ) from error
    except TypeError as error:
        # What Dask raises for an address with TLS where its configuration names no certificate.
        raise InputError(
            f"cluster {address}: speaks TLS, and no certificate is set here; set "
            "DASK_DISTRIBUTED__COMM__TLS__CA_FILE, __CLIENT__CERT and __CLIENT__KEY"
        ) from error
    try:
        yield client
    finally:
        _close(client)


def _check_workers(client: "Client", out: Path) -> None:
    """Raise InputError unless scheduler and workers are there, and able to do the work."""
    address = client.scheduler_info()["address"]
    try:
        client.wait_for_workers(1, timeout=WORKERS_S)
    except TimeoutError as error:
        raise InputError(f"cluster {address}: has no workers; start some") from error
    with replace_file(out / ".cluster", overwrite=True) as token:
        token.touch()
        _check_answer(f"scheduler {address}", _answer_of_scheduler(client), out, False)
        for worker, answer in _answers_of_workers(client, address, str(token)).items():
            _check_answer(f"worker {worker}", answer, out, True)
    (out / ".cluster").unlink(missing_ok=True)


def _answer_of_scheduler(client: "Client") -> Any:
    """Return the scheduler's answer; it must unpack the work before it can pass it on."""
    try:
        return call_within(partial(client.run_on_scheduler, _hello), START_S)
    except Exception as error:
        return error


def _answers_of_workers(client: "Client", address: str, token: str) -> dict[str, Any]:
    """Return the answer of every worker; InputError if one of them does not answer."""
    ask = partial(client.run, _hello, token, on_error="return")
    try:
        return call_within(ask, START_S)
    except TimeoutError as error:
        raise InputError(
            f"cluster {address}: not all workers answer within {START_S:g} s; end those that hang"
        ) from error


def _hello(token: str = "") -> tuple[str, bool]:
    """Return the version of floatref here, and whether file ``token`` is seen here."""
    # The package's own name: a worker of any version has it.
    from floatref import __version__ as here

    return here, Path(token).is_file()


def _check_answer(who: str, answer: Any, out: Path, sees: bool) -> None:
    """Raise InputError unless ``answer`` is that of our version, which sees the folder ``out``."""
    if isinstance(answer, Exception):
        reason = f"{type(answer).__name__}: {answer}"
        task = f"{who}: cannot run floatref ({reason}), it needs version {__version__}"
        raise missing_extra(task, "batch") from answer
    version, seen = answer
    if version != __version__:
        raise InputError(
            f"{who}: has floatref {version}, and we {__version__}; install the same there"
        )
    if sees and not seen:
        raise InputError(f"{who}: does not see {out}; choose a folder that all machines share")
