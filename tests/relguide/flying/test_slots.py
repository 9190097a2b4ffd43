"""Slots: who has a place behind a head, who is refused one, and what is said of it."""

from dataclasses import dataclass, replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.flying.slots import line_of, refuse_taken

LIMIT = 9_260.0
TAS = dict.fromkeys(("LEAD", "OTHER", "A", "B", "C"), 200.0)


@dataclass(frozen=True)
class Claimed:
    pursuer: str
    leader: str
    slot_distance: float = 12_000.0
    min_separation: float = LIMIT
    spacing: float = 0.0


A = Claimed("A", "LEAD")


@pytest.mark.parametrize(
    "others",
    [
        (Claimed("B", "A"),),
        (Claimed("B", "A"), Claimed("C", "B")),
        (Claimed("B", "LEAD", 12_000.0 + LIMIT),),
        (Claimed("B", "OTHER"),),
        (Claimed("B", "LEAD", 30_000.0), Claimed("C", "A", 12_000.0 - 3_260.0, 8_000.0)),
    ],
)
def test_slots_with_room_between_are_all_taken(others: tuple[Claimed, ...]) -> None:
    refuse_taken((A, *others), TAS)


@pytest.mark.parametrize(
    ("second", "sentence"),
    [
        (
            Claimed("B", "LEAD"),
            "B cannot take the slot 6.48 NM behind LEAD: A is to take the one 6.48 NM behind LEAD. "
            "11.48 NM or more behind LEAD is free; or let B follow A.",
        ),
        (Claimed("B", "LEAD", 12_000.0 + LIMIT - 1.0), "B cannot take the slot 11.48 NM behind"),
        (
            Claimed("B", "LEAD", 30_000.0, spacing=60.0),
            "B cannot take the slot 16.20 NM behind LEAD and keep 60 s: A is to take the one ",
        ),
    ],
)
def test_a_slot_that_is_taken_is_refused_with_a_sentence(second: Claimed, sentence: str) -> None:
    with pytest.raises(ValueError, match="is to take") as refused:
        refuse_taken((A, second), TAS)
    assert str(refused.value).startswith(sentence)


def test_places_count_from_the_head_of_the_line() -> None:
    """C claims what B has behind A."""
    with pytest.raises(ValueError, match=r"^C cannot .* B is to take the one 6.48 NM behind A"):
        refuse_taken((A, Claimed("B", "A"), Claimed("C", "LEAD", 24_000.0)), TAS)


def test_what_is_said_to_be_free_is_free() -> None:
    taken = (A, Claimed("B", "A"))
    with pytest.raises(ValueError, match=r"17\.96 NM or more behind LEAD is free"):
        refuse_taken((*taken, Claimed("C", "LEAD")), TAS)
    refuse_taken((*taken, Claimed("C", "LEAD", 17.96 * 1852.0 + 10.0)), TAS)


@given(st.floats(9_260.0, 100_000.0), st.floats(9_260.0, 100_000.0))
def test_the_order_of_two_claims_changes_who_gives_way_and_not_whether(
    one: float, other: float
) -> None:
    claims = (replace(A, slot_distance=one), Claimed("B", "LEAD", other))

    def refused(claims: tuple[Claimed, ...]) -> bool:
        try:
            refuse_taken(claims, TAS)
        except ValueError:
            return True
        return False

    assert refused(claims) == refused(claims[::-1]) == (abs(one - other) < LIMIT - 1e-6)


def test_a_line_runs_from_the_head_and_a_circle_has_none() -> None:
    b, c = Claimed("B", "A"), Claimed("C", "B")
    assert line_of(c, (c, b, A)) == (A, b, c)
    with pytest.raises(ValueError, match="must have a head that follows none of it: B behind A"):
        line_of(b, (Claimed("A", "C"), b, c))
