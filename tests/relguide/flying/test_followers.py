"""Further pursuers of a scenario: their place in the queue, and what is refused."""

from dataclasses import replace

import pytest

from relguide.flying.flight import world_of
from relguide.flying.followers import Follower
from relguide.flying.scenarios import fig_6
from relguide.flying.world import Guided
from relguide.planning.aircraft import Pursuer
from relguide.units import DEG

FIG = fig_6(intent_known=True)


def follower(ident: str, x: float = -80_000.0) -> Follower:
    return Follower(
        ident=ident,
        pursuer=Pursuer(x=x, y=0.0, heading=1.0, tas=220.0, max_bank=25.0 * DEG),
    )


def test_each_joins_the_one_before_it() -> None:
    queue = replace(
        FIG, ahead=(follower("A"), follower("B")), followers=(follower("C"), follower("D"))
    )
    world = world_of(queue)
    links = {link.pursuer: link.leader for link in world.links}
    assert links == {"A": "LEADER", "B": "A", "PURSUER": "B", "C": "PURSUER", "D": "C"}
    assert next(iter(links)) == "PURSUER"
    assert {link.slot_distance for link in world.links} == {FIG.situation.slot_distance}
    assert [one.ident for one in world.aircraft] == ["PURSUER", "LEADER", "A", "B", "C", "D"]
    assert all(isinstance(one.pilot, Guided) for one in world.aircraft[2:])


def test_without_a_queue_the_world_is_that_of_the_pair() -> None:
    world = world_of(FIG)
    assert [one.ident for one in world.aircraft] == ["PURSUER", "LEADER"]
    assert len(world.links) == 1


def test_it_flies_its_type_and_by_a_seed_another_of_it_than_the_pursuer() -> None:
    with_one = replace(FIG, followers=(replace(follower("C"), aircraft_type="A310"),))
    plain, drawn = world_of(with_one).aircraft[-1], world_of(with_one, seed=3).aircraft[-1]
    assert plain.aircraft_type == plain.airframe.designator == "A310"
    assert plain.airframe == plain.known_airframe
    assert drawn.airframe != drawn.known_airframe == plain.airframe
    twins = world_of(replace(FIG, followers=(follower("C"),)), seed=3).aircraft
    assert twins[0].airframe != twins[2].airframe


@pytest.mark.parametrize("name", ["ahead", "followers"])
def test_an_ident_is_its_own(name: str) -> None:
    for ident in ("LEADER", "PURSUER"):
        with pytest.raises(ValueError, match=rf"{name}\[0\]\.ident must be its own: another"):
            replace(FIG, **{name: (follower(ident),)})
    with pytest.raises(ValueError, match=r"followers\[0\]\.ident must be its own"):
        replace(FIG, ahead=(follower("A"),), followers=(follower("A"),))


def test_what_is_no_follower_is_refused() -> None:
    with pytest.raises(ValueError, match=r"followers\[0\]"):
        replace(FIG, followers=("A",))
    with pytest.raises(ValueError, match="ident must not be empty"):
        follower(" ")
    with pytest.raises(ValueError, match="weight"):
        replace(follower("A"), weight=1.0)
