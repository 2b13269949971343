"""Which addresses of a cluster are safe: whoever reaches a Dask cluster can run programs on it."""

from ipaddress import ip_address

from floatref.errors import InputError

ENCRYPTED = ("tls", "wss")
"""Protocols of Dask in which each side shows a certificate of the cluster's own authority."""
DEFAULT = "tcp"
"""Dask's protocol of an address without one."""


def check_encrypted(address: str, allowed: bool) -> None:
    """Raise InputError for a cluster beyond this machine without TLS, unless it is ``allowed``."""
    protocol, separator, rest = address.partition("://")
    if not separator:
        protocol, rest = DEFAULT, address
    host = _host(rest)
    # No host has a space in its name; Dask itself refuses such an address.
    if allowed or protocol in ENCRYPTED or " " in host or _is_loopback(host):
        return
    raise InputError(
        f"cluster {address}: not encrypted, whoever reaches it can run programs on it; start it "
        "with TLS and give tls://HOST:PORT, or add --unencrypted-cluster in a network that you "
        "trust"
    )


def _host(place: str) -> str:
    """Return the host of ``place``, as in HOST:PORT or [::1]:PORT."""
    if place.startswith("["):
        return place[1:].partition("]")[0]
    host, separator, _ = place.rpartition(":")
    return host if separator else place


def _is_loopback(host: str) -> bool:
    if host == "localhost":
        return True
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return False
