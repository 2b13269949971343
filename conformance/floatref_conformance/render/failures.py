"""What `report.html` shows of a check that failed: why, with which numbers, and in pictures."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from floatref_conformance.checks.verdict import CheckResult, Pass, RunResult
from floatref_conformance.render import wording
from floatref_conformance.render.figures import figure_of

MOST_PICTURES = 4
"""Pictures shown for each check."""


@dataclass(frozen=True)
class Markup:
    """A string that is markup already, as the template engine recognizes it."""

    text: str

    def __html__(self) -> str:
        """Return the markup."""
        return self.text


@dataclass(frozen=True)
class Picture:
    """One wheel path of one recording."""

    caption: str
    svg: Markup


@dataclass(frozen=True)
class Failure:
    """A failed check; ``unseen`` recordings of its case have no picture."""

    anchor: str
    id: str
    outcome: str
    title: str
    reason: str
    case: str
    simplest: str
    numbers: tuple[tuple[str, str], ...]
    pictures: tuple[Picture, ...]
    unseen: int
    replay: str
    run: str


def failure(check: CheckResult, result: RunResult, anchor: str, title: str) -> Failure:
    """Return what is shown of ``check``; the ids of its pictures begin with ``anchor``."""
    found = check.counterexample or {}
    pictures = _pictures(check, anchor)
    seen = {caption for caption, _ in pictures}
    return Failure(
        anchor=anchor,
        id=check.id,
        outcome=check.outcome.value,
        title=title,
        reason=check.reason,
        case=str(found.get("case", "")),
        simplest=str(found.get("reason", "")),
        numbers=_numbers(found.get("parameters", {})),
        pictures=tuple(picture for _, picture in pictures),
        unseen=len(check.passes) - len(seen),
        replay=wording.replay_command(found["file"], result) if "file" in found else "",
        run=wording.reproduction(result, check.id),
    )


def _numbers(parameters: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    """Return name and value of every number of a case, the scenario's first."""
    found: list[tuple[str, str]] = []
    for part in ("scenario", "variation"):
        for name, value in parameters.get(part, {}).items():
            found.append((str(name), wording.in_words(value)))
    return tuple(found)


def _pictures(check: CheckResult, anchor: str) -> list[tuple[int, Picture]]:
    """Return the recordings' numbers and pictures by wheel path, at most `MOST_PICTURES`."""
    wanted = [
        (number, done, track)
        for number, done in enumerate(check.passes, start=1)
        for track in _tracks(done, check)
    ]
    return [
        (number, _picture(number, done, track, check, f"{anchor}-{n}"))
        for n, (number, done, track) in enumerate(wanted[:MOST_PICTURES], start=1)
    ]


def _tracks(done: Pass, check: CheckResult) -> list[str]:
    """Return the wheel paths that truth and result have, the one that fails this case first."""
    delivered = {track.name for track in done.result.tracks}
    names = [track.name for track in done.truth.tracks if track.name in delivered]
    worst = check.worst_track
    return sorted(names, key=lambda name: name != worst)


def _picture(number: int, done: Pass, track: str, check: CheckResult, name: str) -> Picture:
    count = len(check.passes)
    which = f"Recording {number} of {count}" if count > 1 else "The recording"
    label = f" ({done.label})" if done.label else ""
    caption = (
        f"{which}{label}, wheel path {track}: elevation of the result against the truth, "
        "short-interval roughness over 7.62 m, and speed."
    )
    return Picture(caption, Markup(figure_of(done, track, name, check.scored_m)))
