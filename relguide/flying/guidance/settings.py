"""All constants of guidance in one record, each with its reason; readable from TOML.

    [guidance]
    bank_in_hand_deg = 3.0
    caution_s = 45.0

Keys are names of fields and end in a unit that people use: _deg, _nm, _m, _kt, _mps, _s …; shares,
the damping and flags have none. What is left out keeps its default.
"""

import tomllib
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any, get_args

from relguide.kernels.flight.guide import Gate
from relguide.kernels.flight.laws import Gains
from relguide.planning.inputs import number, truth
from relguide.units import DEG, KT, NM, Metre, MetrePerSecond, Radian, RadianPerSecond, Second

UNITS = {
    "rad": {"deg": DEG},
    "m": {"nm": NM, "m": 1.0},
    "mps": {"kt": KT, "mps": 1.0},
    "s": {"s": 1.0},
    "radps": {"degps": DEG, "radps": 1.0},
}
"""For the unit of a field: endings of keys, and what their numbers are multiplied by."""
FLAGS = ("always_ask",)
"""Settings that are true or false."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """How guidance plans, tracks, watches and speaks.

    Every field is in the unit that its type names: `Metre` [m], `Second` [s], `MetrePerSecond`
    [m/s], `Radian` [rad], `RadianPerSecond` [rad/s]; shares and the damping are numbers [1].

    Examples:
        >>> gentle = rg.Settings(bank_in_hand=0.09, bank_in_hand_share=0.25)
        >>> round(gentle.planned_bank(0.44), 2)  # where the autopilot may use 0.44 rad [rad]
        0.35
    """

    bank_in_hand: Radian = 2.5 * DEG
    """Plans turn at so much less bank than the autopilot may use: 0.43 m/s² against an offset."""
    bank_in_hand_share: float = 0.1
    """… but no more than this share of it, where the bank is gentle."""
    path_bandwidth: RadianPerSecond = 0.13
    """ω along the committed path: beyond it the bank in hand limits, not the loop."""
    follow_bandwidth: RadianPerSecond = 0.09
    """ω along the leader's flown path: 30 m of its noise ask for 1.5° of bank."""
    damping: float = 0.8
    """ζ of both."""
    intercept: Radian = 30.0 * DEG
    """Steepest angle at which a path is closed on: what flight decks use for a localizer."""
    lag: Second = 1.5
    """How late a bank asked for for a second begins to be felt: the roll loop's 1.75 s, softly."""
    look_ahead: Second = 1.75
    """The roll loop's lag, (1 + kd)/kp."""
    spacing_time: Second = 12.0
    """Lag of the spacing loop: twice the autothrust's and more."""
    braking_share: float = 0.7
    """Of the deceleration at idle thrust: what is left is for a leader that brakes as well."""
    falling_back: MetrePerSecond = 20.0
    """At most 40 kt slower than the leader, to increase the spacing."""
    catching_up: MetrePerSecond = 5.0
    """At least 10 kt faster, or a leader with speed V_P is never reached."""
    separation_buffer: Metre = 0.1 * NM
    """Plans keep d_min and this: twice the tube of a reversal at 22.5° of bank."""
    by_hand_margin: Metre = 100.0
    """… and so much more while the crew flies by hand: of 214 flights along a plan by drawn pilots
    none was farther than this from the autopilot's path, and 99 % were within 82 m."""
    joined_along: Metre = 0.2 * NM
    """Half of D − d_min in Fig. 6; closing at 13 m/s there."""
    joined_across: Metre = 0.1 * NM
    """RNP 0.1, the tightest navigation an airliner is approved for."""
    joined_heading: Radian = 2.0 * DEG
    """Drifts 35 m in a kilometre: the route is kept from there on."""
    capture_turn: Radian = 2.0 * DEG
    """A path that turns less than this from here on is captured from."""
    capture_near: Metre = 60.0
    """… once it is so near to the leader's path: a correction without a bank that is felt, or …"""
    capture_slot: Metre = 800.0
    """… has so little to close: in wind a straight in the air mass meets the leader's ground path
    only at the slot."""
    capture_across: Metre = 600.0
    """How far the path may end beside the leader's: a minute's correction on a straight."""
    capture_late: Metre = 2_000.0
    """… or once it should have ended: the leader did not fly as expected, and its path is nearer
    than any other way round to the slot."""
    overdue: Second = 20.0
    """A path that ended so long ago and is not captured is given up."""
    ask_every: Second = 10.0
    """While the leader is as expected, the exact planner is asked this often for a better path: a
    path that was the fastest stays so along it. Other planners are asked each second."""
    always_ask: bool = False
    """Every planner is asked each second, although what is proved of the committed path may exclude
    a better one: to measure what that costs."""
    lost_across: Metre = 3_000.0
    """So far beside the leader's path, capture and follow give way to a plan."""
    lost_heading: Radian = 100.0 * DEG
    """… or so far off its direction."""
    route_left: Radian = 3.0 * DEG
    """A leader that has turned so far since capture began has left the route that was captured:
    the slot has moved by 0.5 km, which capture takes up, and …"""
    too_far: Metre = 2_000.0
    """… a new plan is made if the slot is farther off than this."""
    leader_off: Metre = 30.0
    """The leader is as expected while nearer than this to where it was expected."""
    leader_turned: Radian = 1.0 * DEG
    """… on the heading expected, but for this: five times as far as an autopilot wanders."""
    leader_speed: MetrePerSecond = 2.0 * KT
    """… at the speed expected, but for this: below what a crew would call a change."""
    turning: RadianPerSecond = 0.3 * DEG
    """A leader that turns faster turns: a quarter of an airliner's rate."""
    settled_for: Second = 4.0
    """A leader is steady again so long after its last change."""
    own_off: Metre = 60.0
    """The aircraft flies its forecast while nearer than this to it."""
    strayed: Metre = 400.0
    """So far beside its path it plans anew from where it is."""
    slot_moved: Metre = 150.0
    """A plan whose slot would be so far off when it ends is made anew."""
    better: Second = 1.0
    """A change of plan costs one or two roll reversals, about a second each."""
    better_share: float = 0.005
    """What is far ahead is uncertain: half a percent of the time to go."""
    better_while_turning: Second = 15.0
    """While the leader turns unannounced, sides are changed only for more than this."""
    caution: Second = 60.0
    """Separation that would be lost within this is announced."""
    watch: Second = 150.0
    """How far ahead the monitor looks when it has to look anew."""
    forecast_error: Metre = 20.0
    """In capture and follow, where no plan keeps a buffer, what is forecast counts as so much less:
    forecasts are within 10 m of what is flown at 20 steps a second."""
    out_for: Second = 60.0
    """A pursuer that follows and has been out of the gate for so long says so."""
    clears_after: Second = 3.0
    """An alert ends so long after its cause."""
    speed_in_hand: MetrePerSecond = 2.0
    """A leader slower than one's least speed by this cannot be followed."""
    announce_after: Second = 30.0
    """Plans that follow a change of the leader are announced no more often than this."""
    shown_apart: Metre = 0.5 * NM
    """A path is news if it leads so far from the one last announced, or …"""
    shown_time: Second = 10.0
    """… joins so much sooner or later,"""
    shown_share: float = 0.05
    """… and by this much of the length or the time to go."""
    promise_every: Second = 10.0
    """That it joins at another time is said no more often than this; but a change three times as
    large as is needed to be news waits for a third of it, …"""
    promise_soonest: Second = 3.0
    """… and none for less than this."""
    unsettled_time: Second = 30.0
    """Once it was said while the leader turns, only so large a change is said before it has
    settled, …"""
    unsettled_share: float = 0.25
    """… and by this much of the time to go: a turn moves the join each second."""
    retry: Second = 5.0
    """Without a plan, one is asked for this often, and less often …"""
    retry_share: float = 0.2
    """… once the leader has done nothing new for five times as long,"""
    retry_longest: Second = 60.0
    """… but never after a longer pause than this."""
    propose_every: Second = 2.0
    """A path that is proposed begins where the aircraft is: it is made anew this often."""
    proposes_on_data_of: Second = 5.0
    """No path is proposed on older data of the leader, …"""
    flies_on_data_of: Second = 10.0
    """… and none is flown on data older than this."""
    look_out: Second = 180.0
    """How long an escape must keep clear: DAIDALUS looks as far."""
    escape_tube: Metre = 60.0
    """What an escape keeps beyond d_min: its turn is planned without the soft ends of the roll."""
    escapes_for: Second = 10.0
    """An escape is flown for so long at least: nothing is gained by wavering."""
    escape_room: Metre = 400.0
    """It is left only with so much more than d_min, or where the slot itself has less."""
    heading_news: Radian = 15.0 * DEG
    """A held heading that changes by more is announced."""
    speed_goes_on: Second = 30.0
    """A leader that changes its speed is taken to go on for so long by the monitor, …"""
    speed_goes_on_escaping: Second = 20.0
    """… and for so long by an escape, which ends sooner."""
    slows_to_share: float = 0.6
    """A leader too slow to be followed may slow down to this share of its speed."""

    def __post_init__(self) -> None:
        """Refuse what is not a positive number, and a flag that is neither true nor false."""
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name in FLAGS:
                truth(field.name, value)
                continue
            try:
                positive = number(field.name, value)
            except ValueError:
                positive = 0.0
            if positive <= 0.0:
                raise ValueError(f"{field.name} must be a number above 0, not {value!r}.")
            object.__setattr__(self, field.name, positive)

    def planned_bank(self, max_bank: Radian) -> Radian:
        """The bank at which plans turn, for an autopilot that may use `max_bank` [rad]."""
        return max_bank - min(self.bank_in_hand, self.bank_in_hand_share * max_bank)

    def gains(self, idle_deceleration: float) -> Gains:
        """The gains of the laws, for an aircraft that slows down so at idle thrust [m/s²]."""
        return Gains(
            self.path_bandwidth,
            self.follow_bandwidth,
            self.damping,
            self.intercept,
            self.lag,
            self.look_ahead,
            self.spacing_time,
            self.braking_share * idle_deceleration,
            self.falling_back,
            self.catching_up,
        )

    @property
    def gate(self) -> Gate:
        """When it has joined, and when it captures."""
        return Gate(
            self.joined_along,
            self.joined_across,
            self.joined_heading,
            self.capture_turn,
            self.capture_near,
            self.capture_slot,
            self.capture_across,
            self.capture_late,
        )


DEFAULT = Settings()
"""What flights use if nothing else is given."""


def load_settings(path: Path | str) -> Settings:
    """Settings from the table `[guidance]` of a TOML file, whose keys end in their units.

    Examples:
        >>> from pathlib import Path
        >>> _ = Path("calm.toml").write_text('''[guidance]
        ... caution_s = 45.0''')
        >>> rg.load_settings("calm.toml").caution  # [s]
        45.0

    Raises:
        ValueError: naming the file and the key, with what would be right.
        OSError: if the file cannot be opened.
    """
    try:
        table = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{path} is not TOML: {error}.") from None
    guidance = table.get("guidance")
    if not isinstance(guidance, dict) or len(table) != 1:
        raise ValueError(f"{path} must have one table, [guidance].")
    known, values = _keys(), dict[str, Any]()
    for key, value in guidance.items():
        if key not in known:
            raise ValueError(
                f"{path}: there is no setting {key!r}; a setting is a field's name and its unit, "
                "for example bank_in_hand_deg."
            )
        if key in FLAGS:
            values[key] = value
            continue
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ValueError(f"{path}: {key} must be a number, not {value!r}.")
        name, factor = known[key]
        if name in values:
            raise ValueError(f"{path}: {name} must be given once, in one unit.")
        values[name] = float(value) * factor
    try:
        return replace(DEFAULT, **values)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _keys() -> dict[str, tuple[str, float]]:
    """Keys of a file: the field that each sets, and what its number is multiplied by."""
    keys: dict[str, tuple[str, float]] = {}
    for field in fields(Settings):
        if field.type in (float, bool):
            keys[field.name] = field.name, 1.0
        else:
            (unit,) = get_args(field.type)[1:]
            keys |= {f"{field.name}_{end}": (field.name, by) for end, by in UNITS[unit].items()}
    return keys
