"""Nobody without the secret of a cluster runs a program on it, and none is asked without TLS."""

import subprocess
import sys
from pathlib import Path
from time import sleep

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.batch.work.encryption import check_encrypted
from floatref.errors import InputError

LOOPBACK = ["127.0.0.1", "127.8.9.1", "localhost", "[::1]"]
HOSTS = ["office-1", "10.0.0.7", "0.0.0.0", "[fe80::1]", "localhost.example.org", "127.0.0.1.a"]
OTHERS = ["tcp", "ws", "ucx", "inproc", "TLS", "tlsx"]
SERVE = """
import sys
from pathlib import Path
from floatref.batch.work.cluster import connect
from floatref.batch.work.worker_patience import silence

if __name__ == "__main__":
    with silence() as shown, connect(Path(sys.argv[1]), 1) as client:
        worker = next(iter(client.scheduler_info()["workers"]))
        Path(sys.argv[1], "new").write_text(f"{client.scheduler.address} {worker}")
        Path(sys.argv[1], "new").rename(Path(sys.argv[1], "addresses"))
        sys.stdin.read()
"""
INTRUDE = """
import sys
from pathlib import Path
from distributed import Client, Security

def leave_a_trace():
    Path(sys.argv[1], "trace").write_text("was here")

how, address = sys.argv[2:]
security = Security.temporary() if how == "another" else None
try:
    with Client(address, timeout=5, security=security) as client:
        client.submit(leave_a_trace).result(timeout=20)
    print("ran")
except Exception as error:
    print("refused", type(error).__name__)
"""


@given(st.sampled_from(LOOPBACK), st.sampled_from(["tcp://", "", "ws://"]), st.integers(1, 65535))
def test_this_machine_needs_no_tls(host: str, protocol: str, port: int) -> None:
    check_encrypted(f"{protocol}{host}:{port}", False)


@given(st.sampled_from(HOSTS), st.sampled_from(OTHERS), st.integers(1, 65535))
def test_beyond_it_plain_addresses_are_refused(host: str, protocol: str, port: int) -> None:
    for address in (f"{protocol}://{host}:{port}", f"{host}:{port}", host):
        with pytest.raises(InputError, match=r"not encrypted.*tls://.*--unencrypted-cluster"):
            check_encrypted(address, False)
        check_encrypted(address, True)
    check_encrypted(f"tls://{host}:{port}", False)


@pytest.mark.slow
@pytest.mark.posix
@pytest.mark.parametrize("how", ["without", "another"])
def test_a_program_without_the_secret_runs_nothing(tmp_path: Path, how: str) -> None:
    """Law: another program of this machine that knows all addresses runs no code there."""
    for name, text in (("serve.py", SERVE), ("intrude.py", INTRUDE)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    serving = subprocess.Popen(
        [sys.executable, str(tmp_path / "serve.py"), str(tmp_path)], stdin=subprocess.PIPE
    )
    try:
        while not (tmp_path / "addresses").exists():
            assert serving.poll() is None
            sleep(0.05)
        scheduler, worker = (tmp_path / "addresses").read_text(encoding="utf-8").split()
        assert scheduler.startswith("tls://127.0.0.1:")
        assert worker.startswith("tls://127.0.0.1:")
        plain = scheduler.replace("tls://", "tcp://")
        for address in [scheduler, *([plain] if how == "without" else [])]:
            command = [sys.executable, str(tmp_path / "intrude.py"), str(tmp_path), how, address]
            done = subprocess.run(command, capture_output=True, text=True, timeout=600)
            assert done.stdout.startswith("refused"), done.stdout + done.stderr
        assert not (tmp_path / "trace").exists()
    finally:
        serving.communicate(timeout=600)
    assert serving.returncode == 0
