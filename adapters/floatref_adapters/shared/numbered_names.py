"""Names of a file, made to differ from each other."""

from collections.abc import Sequence


def number_repeats(names: Sequence[str]) -> list[str]:
    """Return ``names``, a repeated one with a number: `speed`, `speed #2`, `speed #3`.

    All names returned differ, also where the file itself has a name such as `speed #2`.
    """
    given, taken, out = set(names), set[str](), []
    last: dict[str, int] = {}
    for name in names:
        unique, number = name, last.get(name, 1)
        while unique in taken or (number > 1 and unique in given):
            number += 1
            unique = f"{name} #{number}"
        last[name] = number
        taken.add(unique)
        out.append(unique)
    return out
