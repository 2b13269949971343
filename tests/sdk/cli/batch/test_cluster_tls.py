"""`floatref batch --cluster tls://…`: a cluster with certificates, as the page has it."""

import sys
from pathlib import Path
from typing import Any

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.posix]
ROLES = ("SCHEDULER", "WORKER", "CLIENT")


def certify(bench: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Write a certificate, and name it in the environment of what is started."""
    from distributed import Security

    made = Security.temporary()
    for name, text in {"ca": made.tls_ca_file, "key": made.tls_client_key}.items():
        (bench.folder / f"{name}.pem").write_text(str(text), encoding="ascii")
    tls = "DASK_DISTRIBUTED__COMM__TLS__"
    monkeypatch.setenv("DASK_DISTRIBUTED__COMM__REQUIRE_ENCRYPTION", "True")
    monkeypatch.setenv(f"{tls}CA_FILE", str(bench.folder / "ca.pem"))
    for role in ROLES:
        monkeypatch.setenv(f"{tls}{role}__CERT", str(bench.folder / "ca.pem"))
        monkeypatch.setenv(f"{tls}{role}__KEY", str(bench.folder / "key.pem"))


def start(bench: Any, kind: str, *arguments: str) -> Any:
    program = (sys.executable, "-m", f"distributed.cli.dask_{kind}")
    places = ("--scheduler-file", str(bench.folder / "scheduler.json"))
    return bench.start(*places, "--no-dashboard", *arguments, program=program)


def test_a_cluster_with_certificates_works_and_needs_them(
    bench: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench.put(a=("ready", 300))
    with monkeypatch.context() as certified:
        certify(bench, certified)
        start(bench, "scheduler", "--protocol", "tls", "--host", "127.0.0.1", "--port", "0")
        file: Path = bench.folder / "scheduler.json"
        bench.wait_until(lambda: file.exists() and '"address"' in file.read_text(encoding="utf-8"))
        start(bench, "worker", "--nthreads", "1", "--no-nanny", "--host", "127.0.0.1")
        address = bench.scheduler_address()
        assert address.startswith("tls://")
        report = bench.report_of(bench.batch("--cluster", address))
        assert report["files"]["done"] == 1
    code, out, err = bench.ended(bench.batch("--cluster", address, "--resume"))
    assert (code, out) == (2, "")
    assert err.startswith(f"Error: cluster {address}: ")
    assert "\n" not in err


def test_a_plain_address_of_another_machine_is_refused_before_any_work(bench: Any) -> None:
    bench.put(a=("ready", 300))
    code, out, err = bench.ended(bench.batch("--cluster", "tcp://192.0.2.1:8786"))
    assert (code, out) == (2, "")
    assert err.startswith("Error: cluster tcp://192.0.2.1:8786: not encrypted, ")
    assert "--unencrypted-cluster" in err
    assert not bench.out.exists()
