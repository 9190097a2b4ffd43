"""Who a client is: the token it shows; without one its address, of IPv6 the network.

All that has a share for each client, or takes turns, asks here.
"""

from functools import lru_cache
from ipaddress import IPv6Address, ip_address, ip_network

from starlette.types import Scope

NETWORK = 64
"""Bits of an IPv6 address that one customer has at least; the others it chooses as it likes."""
LONGEST = 255
"""Of an address, which a proxy may have made up [characters]."""


def client_of(scope: Scope) -> str:
    """Whose a request or a stream is; empty if that is not known."""
    token: str = scope.get("state", {}).get("token", "")
    return token or client_at((scope.get("client") or ("",))[0])


def client_at(host: str) -> str:
    """Who is at an address: IPv4 as it is, IPv6 by its network."""
    return _network_of(host[:LONGEST]) if ":" in host else host[:LONGEST]


@lru_cache(1000)
def _network_of(host: str) -> str:
    try:
        address = ip_address(host)
    except ValueError:
        return host
    assert isinstance(address, IPv6Address)  # it has a colon
    if address.ipv4_mapped is not None:
        return str(address.ipv4_mapped)
    return str(ip_network((int(address), NETWORK), strict=False))
