"""Profiles and recordings as tables of pandas and xarray, which a plug-in makes.

The SDK knows neither library. `floatref_adapters`, which is installed with it, registers these
views by the hook `floatref_register_views`.
"""

from collections.abc import Callable
from typing import Any

from floatref.engine.plugins import plugins
from floatref.errors import InputError
from floatref.values.profile import Profile
from floatref.values.recording import Recording

HOOK = "floatref_register_views"


def profile_to_pandas(profile: Profile) -> Any:
    """Return ``profile`` as a pandas frame, index `distance_m`; InputError without pandas."""
    return _view("profile_to_pandas")(profile)


def profile_to_xarray(profile: Profile) -> Any:
    """Return ``profile`` as a data set, by track and distance; InputError without xarray."""
    return _view("profile_to_xarray")(profile)


def recording_to_pandas(recording: Recording) -> Any:
    """Return one pandas frame for every clock of ``recording``; InputError without pandas."""
    return _view("recording_to_pandas")(recording)


def recording_to_xarray(recording: Recording) -> Any:
    """Return ``recording`` as a data set, by time; InputError without xarray."""
    return _view("recording_to_xarray")(recording)


def _view(name: str) -> Callable[[Any], Any]:
    """Return the view called ``name`` of all that plug-ins registered; InputError without it."""
    known = plugins().collect(HOOK, _check_view)
    if name not in known:
        raise InputError(f"view {name}: no plug-in registers it; install floatref again")
    view: Callable[[Any], Any] = known[name]
    return view


def _check_view(name: Any, view: Any) -> str:
    """Return ``name``; TypeError unless it is text and ``view`` can be called with a value."""
    if not isinstance(name, str) or not callable(view):
        raise TypeError(f"{name!r} is not the name of a view")
    return name
