"""What the machines of a cluster have to answer before any work."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from floatref import __version__
from floatref.batch.work.cluster import _check_workers
from floatref.errors import InputError

Answer = Callable[[Callable[..., Any], str], Any]


def shares(ask: Callable[..., Any], token: str) -> Any:
    return ask(token)


def sees_another_disk(ask: Callable[..., Any], token: str) -> Any:
    return ask(f"/another/disk{token}")


def lacks_floatref(ask: Callable[..., Any], token: str) -> Any:
    return ModuleNotFoundError("No module named 'floatref'")


def is_older(ask: Callable[..., Any], token: str) -> Any:
    return "0.0.1", True


class Cluster:
    """A client of a scheduler and two workers, the second of which answers with ``answer``."""

    def __init__(self, answer: Answer) -> None:
        self._answer = answer

    def scheduler_info(self) -> dict[str, str]:
        return {"address": "tcp://office:8786"}

    def wait_for_workers(self, count: int, timeout: float) -> None:
        pass

    def run_on_scheduler(self, ask: Callable[..., Any]) -> Any:
        return ask()

    def run(self, ask: Callable[..., Any], token: str, on_error: str) -> dict[str, Any]:
        return {"tcp://one:1": shares(ask, token), "tcp://two:2": self._answer(ask, token)}


def test_workers_that_share_the_folder_will_do(tmp_path: Path) -> None:
    _check_workers(Cluster(shares), tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (sees_another_disk, "does not see {out}; choose a folder that all machines share"),
        (
            lacks_floatref,
            "cannot run floatref (ModuleNotFoundError: No module named 'floatref'), "
            f"it needs version {__version__}; run in a clone of floatref: "
            'pip install -e ".[batch]"',
        ),
        (is_older, f"has floatref 0.0.1, and we {__version__}; install the same there"),
    ],
)
def test_a_worker_that_cannot_do_the_work_is_named(
    tmp_path: Path, answer: Answer, said: str
) -> None:
    with pytest.raises(InputError) as caught:
        _check_workers(Cluster(answer), tmp_path)
    assert str(caught.value) == f"worker tcp://two:2: {said.format(out=tmp_path)}"
    assert list(tmp_path.iterdir()) == []
