"""Orders to a leader: read strictly, given once, at their times."""

import json
from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from io import BytesIO
from itertools import islice, takewhile
from math import pi, radians
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given

from relguide.contract.document_models import from_wire
from relguide.contract.orders import (
    MAX_LINE,
    FlownAgain,
    Order,
    commands_of,
    crew_of,
    expect_flying,
    flown_again,
    read_crew,
    read_orders,
)
from relguide.contract.recorder import is_recording, record, replay
from relguide.contract.wire import dumps
from relguide.flying.documents import CommandGiven, Document, PlanChanged, PlanProposed, Sample
from relguide.flying.flight import fly, world_of
from relguide.flying.orders import (
    CrewCommand,
    IntentKnown,
    LeaderData,
    LeaderHeading,
    LeaderSpeed,
    PursuerBank,
    PursuerHeading,
    PursuerSpeed,
    SetAutopilot,
    SetDirector,
    SetEngagement,
    SetSpacing,
    Stick,
)
from relguide.flying.pilot_model import PilotModel
from relguide.flying.scenarios import fig_6
from relguide.flying.scripted_crew import CrewOrder, begun
from relguide.planning.plan import plan
from tests.documents import orders

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
            "This must have one of leader_heading_deg, leader_tas_mps, leader_level_m, lead",
        ),
        (
            b'{"t_s": 400, "leader_tas_mps": 200, "intent_known": true}',
            "This must have one of leader_heading_deg, leader_tas_mps, leader_level_m, lead",
        ),
        (b'{"leader_tas_mps": 200}', "t_s: is missing: it must be a number of at least 0 s."),
        (b'{"t_s": 59, "intent_known": true}', "t_s: must be at least 60, that of the order befo"),
        (b'{"t_s": -1, "intent_known": true}', "t_s: must be at least 0 s, not -1 s."),
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


CREWS: tuple[tuple[str, CrewCommand], ...] = (
    ('"engagement": "armed"', SetEngagement(engagement="armed")),
    ('"pursuer_heading_deg": 450', PursuerHeading(heading=pi / 2.0)),
    ('"pursuer_max_bank_deg": 20', PursuerBank(bank=radians(20.0))),
    ('"pursuer_tas_mps": 230', PursuerSpeed(tas=230.0)),
    ('"pursuer_tas_mps": null', PursuerSpeed(tas=0.0)),
    ('"slot_distance_m": 12000', SetSpacing(slot_distance=12_000.0)),
    ('"min_separation_m": 5556', SetSpacing(min_separation=5_556.0)),
    (
        '"slot_distance_m": 12000, "min_separation_m": 5556',
        SetSpacing(slot_distance=12_000.0, min_separation=5_556.0),
    ),
    ('"autopilot": false', SetAutopilot(on=False)),
    ('"director": true', SetDirector(on=True)),
    ('"stick_roll": -0.5', Stick(roll=-0.5)),
    ('"stick_roll": -0.5, "stick_pitch": 1', Stick(roll=-0.5, pitch=1.0)),
    ('"leader_data_received": false', LeaderData(received=False)),
)


@pytest.mark.parametrize(("line", "command"), CREWS)
def test_what_a_crew_orders_is_read_in_both_files(line: str, command: CrewCommand) -> None:
    timed = f'{{"t_s": 7, {line}, "ident": "OWN"}}'.encode()
    command = replace(command, ident="OWN")
    assert read_orders(BytesIO(timed), "a") == (Order(7.0, command),)
    assert read_crew(BytesIO(timed), "a") == (CrewOrder(after=7.0, command=command),)
    cued = f'\n{{"on": "alert", "after_s": 3.5, {line}, "ident": "OWN"}}\n'.encode()
    expected = CrewOrder(on="alert", after=3.5, command=command)
    assert read_crew(BytesIO(cued), "a") == (expected,)
    with pytest.raises(ValueError, match=r"^a, line 2: on: waits for a cue, .*: give t_s\.$"):
        read_orders(BytesIO(cued), "a")


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ('"leader_tas_mps": 200', "This must have one of engagement, pursuer_heading_deg, purs"),
        ('"autopilot": 1', "autopilot: must be true or false, not 1."),
        ('"autopilot": true, "director": true', "This must have one of engagement, pursuer_head"),
        ('"stick_roll": 1.5', "stick_roll: must lie in -1 … 1"),
        ('"pursuer_max_bank_deg": 0', "pursuer_max_bank_deg: must lie in 1 … 60 °, not 0 °."),
        (
            '"slot_distance_m": 0',
            "This must have slot_distance_m or min_separation_m above 0",
        ),
        ('"on": "armed", "autopilot": true', "This must have t_s or on, and not both."),
        ('"after_s": 4, "autopilot": true', "This has after_s, which counts from what it waits"),
        ('"engagement": "on"', "engagement: must be 'off', 'designated', 'armed' or 'engaged', n"),
    ],
)
def test_a_line_of_a_script_that_is_no_crews_order_is_named(line: str, sentence: str) -> None:
    script = f'{{"t_s": 1, "director": true}}\n{{"t_s": 2, {line}}}'
    with pytest.raises(ValueError, match=r"^a, line 2: ") as caught:
        read_crew(BytesIO(script.encode()), "a")
    assert str(caught.value).removeprefix("a, line 2: ").startswith(sentence)


def test_a_script_is_in_order_of_time_where_it_waits_for_no_cue() -> None:
    """It was sorted without a word."""
    later, cued = b'{"t_s": 9, "director": true}\n', b'{"on": "armed", "director": true}\n'
    assert [one.on for one in read_crew(BytesIO(later + cued + later), "a")] == [
        "start",
        "armed",
        "start",
    ]
    said = r"^a, line 3: t_s: must be at least 9, that of the order before, not 8\.$"
    with pytest.raises(ValueError, match=said):
        read_crew(BytesIO(later + cued + b'{"t_s": 8, "director": true}\n'), "a")


@pytest.mark.parametrize("text", [b"", b"\n \n"])
def test_an_empty_script_is_refused(text: bytes) -> None:
    """An hour was flown with guidance off, without a word."""
    with pytest.raises(ValueError, match=r"^a: It is empty, and a crew's script has one order or"):
        read_crew(BytesIO(text), "a")


def test_a_crew_may_wait_for_any_of_its_cues_and_no_other() -> None:
    with pytest.raises(ValueError, match=r"^a, line 1: on: must be 'start', .* or 'alert', not "):
        read_crew(BytesIO(b'{"on": "arm", "director": true}'), "a")
    wrong = CrewOrder(on="armed", command=SetDirector(on=True, ident="LEADER"))
    script, world = (
        (CrewOrder(command=SetDirector(on=True)), wrong),
        world_of(fig_6(intent_known=True)),
    )
    with pytest.raises(ValueError, match=r"^The crew's order 2: .* no pursuer, so it has no crew"):
        expect_flying((), script, world)


def test_a_script_says_how_far_guidance_is_engaged_as_it_begins() -> None:
    engage = CrewOrder(command=SetEngagement(engagement="engaged"))
    later = CrewOrder(after=1.0, command=SetEngagement(engagement="engaged"))
    assert begun((engage, later)) == ("engaged", (later,))
    assert begun((later, engage)) == ("off", (later, engage))
    assert begun(()) == ("off", ())


@given(command=orders())
def test_an_order_is_read_back_from_a_recording_to_the_bit(command: Any) -> None:
    given_ = CommandGiven(t=1.0, command=command)
    assert from_wire(dumps(given_)) == given_


@pytest.mark.slow
def test_a_hand_flown_flight_is_flown_again_to_the_bit(tmp_path: Path) -> None:
    """From the orders that its recording holds, whoever gave them."""
    said: tuple[tuple[float, Any], ...] = (
        (3.0, SetEngagement(engagement="designated")),
        (8.0, SetEngagement(engagement="armed")),
        (14.0, SetEngagement(engagement="engaged")),
        (20.0, SetAutopilot(on=False)),
        (20.0, SetDirector(on=True)),
        (21.35, Stick(roll=0.7, pitch=-0.1)),
        (24.6, Stick(roll=-1.0 / 3.0)),
        (28.2, LeaderHeading(heading=2.7182818, direction="left")),
        (31.15, Stick(roll=0.0)),
        (40.0, SetSpacing(slot_distance=13_000.0)),
        (55.0, PursuerBank(bank=0.3)),
        (70.0, SetAutopilot(on=True)),
        (90.0, PursuerSpeed(tas=231.7)),
        (120.0, SetEngagement(engagement="off")),
        (121.0, PursuerHeading(heading=-1.2345678)),
    )
    flight = partial(fly, fig_6(intent_known=True), plan)
    file = tmp_path / "hand.jsonl.gz"
    first = flight(commands=_saying(said), engagement="off", seed=7)
    flown = list(record(takewhile(lambda one: one.t < 150.0, first), file, sample_rate=None))
    assert is_recording(file)
    again = flown_again(replay(file))
    assert (again.engagement, again.seed, len(again.orders)) == ("off", 7, len(said))
    second = flight(
        commands=commands_of(again.orders), engagement=again.engagement, seed=again.seed
    )
    assert [_timeless(one) for one in takewhile(lambda one: one.t < 150.0, second)] == [
        _timeless(one) for one in flown
    ]
    assert any(isinstance(one, Sample) and not one.guidance[0].autopilot for one in flown)


def _saying(said: Iterable[tuple[float, Any]]) -> Any:
    return commands_of([Order(t, command) for t, command in said])


def _timeless(document: Document) -> Document:
    """A document without what the machine took to compute it."""
    if isinstance(document, PlanChanged | PlanProposed):
        return replace(document, plan=replace(document.plan, compute=0.0))
    return document


def test_a_recording_says_how_its_flight_began_and_orders_are_none(tmp_path: Path) -> None:
    file = tmp_path / "a.jsonl"
    documents = fly(fig_6(intent_known=True), plan, sample_period=1.0, seed=3)
    list(record(takewhile(lambda one: one.t < 3.0, documents), file))
    assert flown_again(replay(file)) == FlownAgain((), "engaged", 3, fig_6(intent_known=True).name)
    with pytest.raises(ValueError, match="lacks its beginning"):
        flown_again([])
    for other in (ORDERS, b"", b"\xff", b"[]"):
        file.write_bytes(other)
        assert not is_recording(file)


@pytest.mark.parametrize("pilot", [None, PilotModel()])
@pytest.mark.parametrize(
    "given",
    [
        (),
        (SetAutopilot(on=False), SetDirector(on=True)),
        (SetDirector(on=True), SetAutopilot(on=False)),
        (SetAutopilot(on=True),),
    ],
)
def test_a_recording_says_whether_a_pilot_model_flew_whatever_was_ordered_at_once(
    given: tuple[CrewCommand, ...], pilot: PilotModel | None
) -> None:
    commands = commands_of([Order(0.0, command) for command in given])
    flight = replace(fig_6(intent_known=True), by_hand=pilot)
    flown = islice(fly(flight, plan, commands=commands, sample_period=1.0), 12)
    unsaid = given[:1] == (SetDirector(on=True),)  # its order could have put the bars on as well
    assert flown_again(flown).by_pilot == (pilot is not None and not unsaid)


@pytest.mark.parametrize(
    ("script", "said"),
    [
        (7, "crew must be a list or a tuple, not 7"),
        ({"on": "armed"}, "crew must be a list or a tuple, not "),
        ([{"on": "armed", "autopilot": False}, 7], "crew, order 2: This must be an object"),
        (["{}"], "crew, order 1: This must be an object"),
    ],
)
def test_what_is_no_script_of_a_crew_is_refused_in_a_sentence(script: Any, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        crew_of(script)
