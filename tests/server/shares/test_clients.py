"""Who a client is, for all that has a share for each."""

import pytest
from relguide_server.shares.clients import client_at, client_of


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("192.0.2.1", "192.0.2.1", True),
        ("192.0.2.1", "192.0.2.2", False),
        ("2001:db8:1:2::1", "2001:db8:1:2:ffff::9", True),
        ("2001:db8:1:2::1", "2001:db8:1:3::1", False),
        ("::ffff:192.0.2.1", "192.0.2.1", True),
        ("not:an:address", "not:another", False),
    ],
)
def test_an_address_of_ipv6_counts_by_its_network(one: str, other: str, same: bool) -> None:
    assert (client_at(one) == client_at(other)) is same


def test_who_shows_a_token_is_known_by_it_wherever_it_is() -> None:
    here, there = ("192.0.2.1", 1), ("2001:db8::1", 2)
    shown = {"state": {"token": "a"}}
    assert client_of({"client": here, **shown}) == client_of({"client": there, **shown})
    assert client_of({"client": here}) != client_of({"client": here, **shown})
    assert client_of({"client": None}) == ""
