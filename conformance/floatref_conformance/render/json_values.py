"""Values as JSON has them."""

from collections.abc import Mapping
from math import isfinite
from typing import Any


def finite(value: Any) -> Any:
    """Return ``value`` with null in place of every number that JSON does not have.

    Mappings, lists and tuples are followed inwards; mappings become dictionaries, the other two
    lists.
    """
    if isinstance(value, float) and not isfinite(value):
        return None
    if isinstance(value, Mapping):
        return {str(key): finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(item) for item in value]
    return value
