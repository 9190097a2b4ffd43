"""Orders to a leader: read strictly, given once, at their times."""

import json
from io import BytesIO
from math import pi

import pytest

from relguide.contract.orders import MAX_LINE, Order, commands_of, expect_flying, read_orders
from relguide.flying.flight import world_of
from relguide.flying.orders import IntentKnown, LeaderHeading, LeaderSpeed
from relguide.flying.scenarios import fig_6

ORDERS = (
    b'{"t_s": 60, "intent_known": false}\n'
    b'{"t_s": 300, "leader_heading_deg": 180, "direction": "left"}\n'
    b"\n"
    b'{"t_s": 300, "leader_heading_deg": -90}\n'
    b'{"t_s": 950.5, "leader_tas_mps": 100}'
)


def test_orders_are_read_in_order() -> None:
    assert read_orders(BytesIO(ORDERS), "a.jsonl") == (
        Order(60.0, IntentKnown(known=False)),
        Order(300.0, LeaderHeading(heading=pi, direction="left")),
        Order(300.0, LeaderHeading(heading=1.5 * pi)),
        Order(950.5, LeaderSpeed(tas=100.0)),
    )
    assert read_orders(BytesIO(b""), "a.jsonl") == ()


def test_an_order_may_name_who_is_to_do_so() -> None:
    (order,) = read_orders(BytesIO(b'{"t_s": 9, "leader_tas_mps": 210, "ident": "BAW12"}'), "a")
    assert order == Order(9.0, LeaderSpeed(tas=210.0, ident="BAW12"))
    world = world_of(fig_6(intent_known=True))
    with pytest.raises(ValueError, match=r"^The order at 9 s: There is no aircraft 'BAW12' to "):
        expect_flying((order,), (), world)
    expect_flying((Order(9.0, LeaderSpeed(tas=210.0, ident="LEADER")),), (), world)


def test_each_is_given_once_at_its_time() -> None:
    orders = read_orders(BytesIO(ORDERS), "a.jsonl")
    commands = commands_of(orders)
    given = [(n, len(list(commands(n * 0.05)))) for n in range(20_001)]
    assert [one for one in given if one[1]] == [(1_200, 1), (6_000, 2), (19_010, 1)]
    assert list(commands(1e6)) == []
    # another flight gets them again
    assert len(list(commands_of(orders)(1e6))) == 4


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        (b"go", "This is not JSON"),
        (b"[]", "A line must be an object with fields: an order."),
        (b"\xff", "This is not UTF-8 text"),
        (
            b'{"t_s": 400}',
            "This must have one of leader_heading_deg, leader_tas_mps, leader_level_m, inte",
        ),
        (
            b'{"t_s": 400, "leader_tas_mps": 200, "intent_known": true}',
            "This must have one of leader_heading_deg, leader_tas_mps, leader_level_m, inte",
        ),
        (b'{"leader_tas_mps": 200}', "t_s: is missing."),
        (b'{"t_s": 59, "intent_known": true}', "t_s: must be at least 60, that of the order befo"),
        (b'{"t_s": -1, "intent_known": true}', "t_s: must be at least 0, not -1"),
        (b'{"t_s": NaN, "intent_known": true}', "NaN is not a number in JSON"),
        (b'{"t_s": 1e999, "intent_known": true}', "t_s: must be a finite number"),
        (b'{"t_s": "70", "intent_known": true}', 't_s: must be a number, not the text "70".'),
        (b'{"t_s": 70, "intent_known": 1}', "intent_known: must be true or false, not 1."),
        (b'{"t_s": 70, "intent_known": null}', "intent_known: must be true or false, not null."),
        (b'{"t_s": 70, "leader_tas_mps": 29}', "leader_tas_mps: must lie in 30 … 400 m/s, not 29"),
        (
            b'{"t_s": 70, "leader_tas_mps": 401}',
            "leader_tas_mps: must lie in 30 … 400 m/s, not 401",
        ),
        (b'{"t_s": 70, "leader_heading_deg": 1e999}', "leader_heading_deg: must be a finite num"),
        (
            b'{"t_s": 70, "leader_heading_deg": 9, "direction": "up"}',
            "direction: must be 'left', 'right' or 'shorter', not the text \"up\".",
        ),
        (
            b'{"t_s": 70, "leader_tas_mps": 200, "direction": "left"}',
            "direction: is not a field of the contract: leave it out.",
        ),
        (b'{"t_s": 70, "t_s": 80, "intent_known": true}', "t_s: is given more than once"),
        (b'{"t_s": 70' + b" " * MAX_LINE, "This is longer than 10,000 bytes"),
    ],
)
def test_a_line_that_is_no_order_is_named(line: bytes, sentence: str) -> None:
    first = json.dumps({"t_s": 60, "intent_known": False}).encode()
    with pytest.raises(ValueError, match=r"^a\.jsonl, line 2: ") as caught:
        read_orders(BytesIO(first + b"\n" + line + b"\n"), "a.jsonl")
    assert str(caught.value).removeprefix("a.jsonl, line 2: ").startswith(sentence)
