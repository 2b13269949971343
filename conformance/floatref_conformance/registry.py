"""Kinds of devices and checks by name, as the plug-ins registered them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from floatref.errors import FloatrefError, InputError
from floatref.values.display.similar_names import nearest, suggest
from floatref_conformance.checks.catalogue import IDS, LeftOut, not_built
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.devices.interface import Device, DeviceKind


@dataclass(frozen=True)
class Registry:
    """What can be run: kinds of devices by prefix, checks by id, and plug-ins left out.

    ``broken`` has one line with the reason for each plug-in that was left out.
    """

    kinds: Mapping[str, DeviceKind]
    checks: Mapping[str, Check]
    broken: tuple[str, ...] = ()

    def device(self, spec: str) -> Device:
        """Return the device that ``spec`` names.

        Raises InputError if its kind or name is unknown, or if its kind cannot make it.
        """
        prefix, colon, argument = spec.partition(":")
        if not colon or not argument or prefix not in self.kinds:
            raise InputError(f"device {spec}: not a kind that works here; {self._meant(spec)}")
        try:
            return self.kinds[prefix].make(argument)
        except (FloatrefError, KeyboardInterrupt):
            raise
        except BaseException as error:
            raise InputError(f"device {spec}: {type(error).__name__}: {error}") from error

    def check(self, id_: str) -> Check:
        """Return check ``id_``; InputError if it is unknown or not built yet."""
        if id_ in self.checks:
            return self.checks[id_]
        if id_ in IDS:
            here = ", ".join(self.checks)
            raise InputError(f"check {id_}: not built yet; these can be run: {here}")
        near = nearest(id_, STREAM_CHECKS)
        if near:
            raise InputError(f"check {id_}: unknown check; did you mean {near}?")
        known = suggest(id_, self.checks, "these can be run:")
        raise InputError(f"check {id_}: unknown check; {known}")

    def _meant(self, spec: str) -> str:
        """Return a hint at the device that ``spec`` was meant to name, with its kind."""
        prefix, _, argument = spec.partition(":")
        usages = {kind.usage.partition(":")[0]: kind.usage for kind in self.kinds.values()}
        named = [
            f"{kind.prefix}:{entry.name}"
            for kind in self.kinds.values()
            for entry in kind.entries()
            if entry.name == (argument or prefix)
        ]
        if named:
            return f"did you mean {named[0]}?"
        near = nearest(prefix, usages)
        if near and argument:
            return f"did you mean {near}:{argument}?"
        return f"these do: {', '.join(usages.values())}"

    def select(self, ids: Sequence[str]) -> tuple[tuple[Check, ...], tuple[LeftOut, ...]]:
        """Return the checks to run, and every other check with the reason why it is not run.

        Without ``ids`` every check runs; ids of checks of streams select no check here. Raises
        InputError for an id that cannot be run.
        """
        ours = [id_ for id_ in ids if id_ not in STREAM_CHECKS] if ids else self.checks
        wanted = {id_: self.check(id_) for id_ in ours}
        chosen = tuple(check for check in self.checks.values() if check.id in wanted)
        others = [check for check in self.checks.values() if check.id not in wanted]
        unselected = tuple(LeftOut(c.id, "not selected", c.clause) for c in others)
        return chosen, unselected + not_built(self.checks)

    def killers(self, id_: str) -> tuple[str, ...]:
        """Return the SPECs of the devices that check ``id_`` must fail."""
        return tuple(
            f"{kind.prefix}:{entry.name}"
            for kind in self.kinds.values()
            for entry in kind.entries()
            if id_ in entry.fails
        )
