"""The flights that have a name: the paper's by figure number, and a recorded leader.

The paper does not say when the leader of Fig. 6 turns. Both figures were flown for turns at 60 …
870 s. In 6b the pursuer only turns right, 46° in all, whenever that is (51° at 60 s). In 6a, if the
leader turns

- before 775 s, the pursuer is far out: it turns right as well, and joins up to 22 % later than in
  6b (at 360 s), but nothing sways (at most 66° of heading swing);
- at 790 … 850 s, it is in its last turn onto the old route. It has converged after its first right
  turn, changes its heading as the leader's goes round, is too close for the new slot, and comes
  back by a wide turn right: swing 173 … 195° against 46°, joining 13 … 15 % later;
- at 870 s, it has joined before.

Only the second is section 5's "very swaying trajectory", so `LEADER_TURNS_AT` is in its middle:
820 s, 6a joins at 1,016 s with a swing of 187°, 6b at 916 s (planned: 904 s, promised: 917 s) with
46°.
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from importlib.util import find_spec
from math import cos, sin

from relguide.flying.air import STANDARD_AIR, Air
from relguide.flying.airframe_files import airframe
from relguide.flying.amid_scenarios import crossing_stream, thunderstorm_line
from relguide.flying.dispersion import random_situation
from relguide.flying.envelope import level_for
from relguide.flying.flight import DEFAULT_TYPE, Scenario
from relguide.flying.lesson_scenarios import lesson_bar, lesson_raw, lesson_turn
from relguide.flying.queue_scenarios import overtaking_queue, stream_of_five
from relguide.flying.recordings.samples import DEFAULT_LEADER, INSTALL, load_sample
from relguide.flying.tracks import RecordedTrack
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.inputs import expect, number
from relguide.planning.intent import ChangeLevel, FlyStraight, TurnTo
from relguide.planning.situation import Situation
from relguide.planning.trajectory import RIGHT
from relguide.planning.wind import CALM
from relguide.units import DEG, FT, NM, Metre, Second

LEADER_TURNS_AT: Second = 820.0
"""When the leader of Fig. 6 begins its turn [s]."""
FASTER = 1.2
"""How much faster than a recorded leader its pursuer flies."""
BEHIND: Metre = 30_000.0
"""How far behind the recorded leader the pursuer begins [m]."""
ABEAM: Metre = 20_000.0
"""… and how far to the left of its track [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedScenario:
    """A scenario as it is listed, and how to make it."""

    name: str
    title: str
    description: str
    build: Callable[[], Scenario]
    """Raises `ValueError` with a sentence if its data is not there."""
    missing: Callable[[], str]
    """What to install before it can be built; empty if it can be built."""


def fig_6(*, intent_known: bool, leader_turns_at: Second = LEADER_TURNS_AT) -> Scenario:
    """Fig. 6a (intent unknown) or 6b (intent known); they differ in nothing else.

    Args:
        intent_known: whether the pursuer knows of the leader's turn.
        leader_turns_at: when the leader turns [s].
    """
    name = "fig_6b" if intent_known else "fig_6a"
    return Scenario(
        name=name,
        title=TITLES[name],
        description=DESCRIPTIONS[name],
        situation=Situation(
            pursuer=Pursuer(
                x=-40_000.0, y=40_000.0, heading=90.0 * DEG, tas=240.0, max_bank=25.0 * DEG
            ),
            leader=Leader(
                x=0.0,
                y=0.0,
                heading=90.0 * DEG,
                tas=200.0,
                intent=(
                    FlyStraight(duration=leader_turns_at),
                    TurnTo(heading=135.0 * DEG, turn=RIGHT, bank=25.0 * DEG),
                ),
            ),
            slot_distance=10_000.0,
            min_separation=5.0 * NM,
            wind=CALM,
        ),
        intent_known=intent_known,
    )


def leader_descends() -> Scenario:
    """Behind a leader that descends by 6,000 ft as it has declared, from 4,000 ft above it."""
    name = "leader_descends"
    descent = FlyStraight(duration=120.0), ChangeLevel(to_altitude=25_000.0 * FT, rate=8.0)
    return Scenario(
        name=name,
        title=TITLES[name],
        description=DESCRIPTIONS[name],
        situation=Situation(
            pursuer=Pursuer(
                x=-35_000.0,
                y=25_000.0,
                heading=90.0 * DEG,
                tas=235.0,
                max_bank=25.0 * DEG,
                altitude=35_000.0 * FT,
            ),
            leader=Leader(
                x=0.0,
                y=0.0,
                heading=90.0 * DEG,
                tas=205.0,
                intent=descent,
                altitude=31_000.0 * FT,
            ),
            slot_distance=10_000.0,
            min_separation=5.0 * NM,
            wind=CALM,
        ),
    )


def scenario_behind(
    track: RecordedTrack, *, behind: Metre = BEHIND, abeam: Metre = ABEAM
) -> Scenario:
    """A flight behind a recorded leader, by a pursuer 20 % faster, behind it and to its left.

    The pursuer is slower than that where its type cannot fly so fast at the leader's level.

    Examples:
        >>> from pathlib import Path
        >>> _ = Path("one.scn").write_text("00:00:00>CRE KL204 A320 52.0,4.0 90 FL310 280")
        >>> rg.scenario_behind(rg.load_track("one.scn"), behind=40e3).leader_ident
        'KL204'

    Args:
        track: the leader; its heading and speed changes come as they were flown, unannounced.
        behind: where the pursuer begins, back along the leader's first track [m].
        abeam: and to the left of it [m].
    """
    expect("track", track, RecordedTrack)
    behind, abeam = number("behind", behind), number("abeam", abeam)
    first = track.state_at(0.0)
    along_x, along_y = sin(first.track), cos(first.track)
    fast = max(first.ground_speed, *(track.state_at(t).ground_speed for t in (60.0, 180.0)))
    can = airframe(DEFAULT_TYPE).tas_range(first.altitude, STANDARD_AIR, bank=25.0 * DEG)
    speed = min(max(FASTER * fast, can.least), can.most)
    return Scenario(
        name="recorded_leader",
        title=TITLES["recorded_leader"],
        description="The leader flies as it was recorded, its intent unknown; the pursuer begins "
        f"{behind / 1000.0:g} km behind it and {abeam / 1000.0:g} km to its left. {track.taken}",
        situation=Situation(
            pursuer=Pursuer(
                x=first.x - behind * along_x - abeam * along_y,
                y=first.y - behind * along_y + abeam * along_x,
                heading=first.track,
                tas=speed,
                max_bank=25.0 * DEG,
            ),
            leader=Leader(x=first.x, y=first.y, heading=first.track, tas=first.ground_speed),
            slot_distance=10_000.0,
            min_separation=5.0 * NM,
            wind=CALM,
        ),
        intent_known=False,
        leader_source=track,
        leader_ident=track.ident or "LEADER",
        leader_type=track.aircraft_type or "unknown",
        altitude=first.altitude,
    )


def scenario(name: str) -> Scenario:
    """The scenario of that name.

    Examples:
        >>> rg.scenario("fig_6a").title
        "Fig. 6a: the leader's intent is unknown"

    Raises:
        ValueError: if there is no such scenario, or its data is not installed, in a sentence.
    """
    expect("name", name, str)
    if name not in SCENARIOS:
        raise ValueError(no_scenario(name, SCENARIOS))
    return SCENARIOS[name].build()


def no_scenario(name: str, known: Collection[str]) -> str:
    """What is wrong with a name that no scenario has, and which it may be meant for."""
    meant = get_close_matches(name, known, n=1, cutoff=0.8)
    asked = f" (did you mean {meant[0]}?)" if meant else ""
    return f"There is no scenario {name!r}{asked}; there are {', '.join(known)}."


def own_scenario(
    situation: Situation, *, intent_known: bool = True, isa_deviation: float = 0.0
) -> Scenario:
    """A situation of one's own, flown by an A300 at the level nearest to FL310 where it can.

    Examples:
        >>> rg.own_scenario(rg.scenario("fig_6b").situation).altitude  # [m]
        9449.0

    Args:
        situation: where both begin, and the leader's intent.
        intent_known: whether the pursuer knows it.
        isa_deviation: temperature above the standard atmosphere's [K].

    Raises:
        ValueError: if there is no level at which it can fly so fast or bank so much, in a sentence.
    """
    expect("situation", situation, Situation)
    return Scenario(
        name="own",
        title="Own situation",
        description="A situation that was sent.",
        situation=situation,
        intent_known=intent_known,
        altitude=_level(situation, isa_deviation),
        isa_deviation=isa_deviation,
    )


def random_scenario(seed: int) -> Scenario:
    """A flight drawn at random.

    Args:
        seed: the same gives the same flight.
    """
    situation = random_situation(seed)
    return Scenario(
        name="random",
        title=f"A flight at random, number {seed}",
        description="Start, speeds, distances, wind and the leader's intent are drawn by chance.",
        situation=situation,
        altitude=_level(situation),
    )


def _level(situation: Situation, isa_deviation: float = 0.0) -> Metre:
    """Where the pursuer can fly its own speed and, if there is such a level, its leader's."""
    own, can = situation.pursuer.tas, airframe(DEFAULT_TYPE)
    air, bank = Air(isa_deviation=isa_deviation), situation.pursuer.max_bank
    try:
        slowest = min(own, situation.leader.tas)
        return level_for(can, air, slowest=slowest, fastest=own, bank=bank)
    except ValueError:
        return level_for(can, air, slowest=own, fastest=own, bank=bank)


def _named(name: str, build: Callable[[str, str], Scenario]) -> Scenario:
    return build(TITLES[name], DESCRIPTIONS[name])


def _report_nothing() -> str:
    return ""


def _samples_missing() -> str:
    if find_spec("traffic") is not None:
        return ""
    return f"Recorded tracks come with the package traffic, which is not installed: {INSTALL}"


TITLES = {
    "fig_6a": "Fig. 6a: the leader's intent is unknown",
    "fig_6b": "Fig. 6b: the leader's intent is known",
    "recorded_leader": "A recorded leader",
    "leader_descends": "A leader that descends",
    "stream_of_five": "A stream of five",
    "overtaking_queue": "A faster aircraft joins a queue",
    "crossing_stream": "A stream crosses the way",
    "thunderstorm_line": "A line of thunderstorms",
    "lesson_bar": "Lesson 1: follow the bar",
    "lesson_raw": "Lesson 2: converge without it",
    "lesson_turn": "Lesson 3: the leader turns untold",
}
DESCRIPTIONS = {
    "fig_6a": "The leader turns right to 135° without announcement; the pursuer, 40 km behind and "
    "40 km north, has to change its plan.",
    "fig_6b": "The leader turns right to 135° and has announced it; the pursuer, 40 km behind and "
    "40 km north, makes for the route after the turn from the start.",
    "recorded_leader": "The leader flies as it was recorded by ADS-B near Paris, intent unknown; "
    "the pursuer begins 30 km behind it and 20 km to its left.",
    "leader_descends": "The leader descends from FL310 to FL250 as it has announced; the pursuer, "
    "at FL350 behind it, goes to its level and joins there.",
    "stream_of_five": "Five aircraft from both sides join behind a leader that turns by 30°, each "
    "a minute behind the one before.",
    "overtaking_queue": "A pursuer that flies 245 m/s from far behind joins the end of a queue of "
    "three behind a leader that flies 200 m/s.",
    "crossing_stream": "Six aircraft in a row cross the way to the leader; the pursuer passes "
    "between two of them and keeps 5 NM from each.",
    "thunderstorm_line": "Three cells that move and grow lie in the way; the pursuer finds a gap.",
    "lesson_bar": "A right turn, a straight, a left turn, flown by hand along the bars of the "
    "flight director.",
    "lesson_raw": "Two right turns and a straight, flown by hand from the display alone.",
    "lesson_turn": "The leader turns left by 40° without a word; flown by hand, along bars that "
    "lead to the new path.",
}
SCENARIOS: Mapping[str, NamedScenario] = {
    name: NamedScenario(
        name=name,
        title=TITLES[name],
        description=DESCRIPTIONS[name],
        build=build,
        missing=missing,
    )
    for name, build, missing in (
        ("fig_6a", lambda: fig_6(intent_known=False), _report_nothing),
        ("fig_6b", lambda: fig_6(intent_known=True), _report_nothing),
        ("recorded_leader", lambda: scenario_behind(load_sample(DEFAULT_LEADER)), _samples_missing),
        ("leader_descends", leader_descends, _report_nothing),
        ("stream_of_five", lambda: _named("stream_of_five", stream_of_five), _report_nothing),
        ("overtaking_queue", lambda: _named("overtaking_queue", overtaking_queue), _report_nothing),
        ("crossing_stream", lambda: _named("crossing_stream", crossing_stream), _report_nothing),
        (
            "thunderstorm_line",
            lambda: _named("thunderstorm_line", thunderstorm_line),
            _report_nothing,
        ),
        ("lesson_bar", lambda: _named("lesson_bar", lesson_bar), _report_nothing),
        ("lesson_raw", lambda: _named("lesson_raw", lesson_raw), _report_nothing),
        ("lesson_turn", lambda: _named("lesson_turn", lesson_turn), _report_nothing),
    )
}
"""All of them, by name."""
