"""One table says which mode may follow which: flights keep to it, and nothing else passes."""

import pytest

from relguide.flying.documents import ModeChanged
from relguide.flying.flight import Command, IntentKnown, LeaderHeading, LeaderSpeed
from relguide.flying.modes import MAY_FOLLOW, NAMES, NUMBERS, Mode, change
from relguide.flying.scenarios import fig_6, own_scenario
from relguide.units import DEG
from tests.flights import fly_whole, random_start

MODES: tuple[Mode, ...] = ("heading", "converge", "capture", "follow", "escape")


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("to", MODES)
def test_only_what_the_table_allows_is_entered(mode: Mode, to: Mode) -> None:
    if to == mode or to in MAY_FOLLOW[mode]:
        assert change(mode, to) == to
        return
    with pytest.raises(ValueError, match=f"^{to} may not follow {mode}\\.$"):
        change(mode, to)


def test_the_table_is_whole() -> None:
    assert set(MAY_FOLLOW) == set(MODES) == set(NUMBERS)
    assert {NAMES[NUMBERS[mode]] for mode in MODES} == set(MODES)
    # without a plan nothing is captured or followed, and whatever is flown can be left
    assert not {"capture", "follow"} & (MAY_FOLLOW["heading"] | MAY_FOLLOW["escape"])
    assert all("escape" in MAY_FOLLOW[mode] for mode in MODES if mode != "escape")


@pytest.mark.slow
def test_flights_of_every_kind_go_by_the_table_from_mode_to_mode() -> None:
    orders: tuple[tuple[tuple[float, Command], ...], ...] = (
        (),
        ((950.0, LeaderSpeed(tas=100.0)), (1_100.0, LeaderSpeed(tas=200.0))),
        ((950.0, LeaderHeading(heading=300.0 * DEG)),),
        ((880.0, IntentKnown(known=False)), (1_000.0, LeaderHeading(heading=270.0 * DEG))),
    )
    figures = (fig_6(intent_known=True), fig_6(intent_known=False))
    flights = [fly_whole(figure, *said) for figure in figures for said in orders]
    flights += [
        fly_whole(own_scenario(random_start(seed), intent_known=False)) for seed in (12, 21)
    ]
    entered = set()
    for flight in flights:
        mode: Mode = "heading"
        for document in flight.of(ModeChanged):
            assert document.previous == mode
            assert document.mode in MAY_FOLLOW[mode]
            mode = document.mode
            entered.add(mode)
        assert flight.samples[-1].guidance.mode == mode
    assert entered >= {"converge", "capture", "follow", "escape"}
