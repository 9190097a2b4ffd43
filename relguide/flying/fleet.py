"""The aircraft of a world in flight: one call flies a whole second for all.

    what each knows → guidance (once a second) → a second flown → what each knows

Guidance sees a `Belief`, never the world.
"""

from dataclasses import replace
from math import cos, hypot, inf, sin

import numpy as np
from numpy.typing import NDArray

from relguide.flying.abilities import limits_of
from relguide.flying.aircraft import AircraftState
from relguide.flying.leaders.declared import (
    Program,
    TurnChoice,
    program_of,
    turn_program,
)
from relguide.flying.leaders.recorded import RecordedLeader, steps_of_track, steps_to
from relguide.flying.tracks import TrackState
from relguide.flying.vertical import (
    begin_change,
    climb_by_stick,
    commanded_climb,
    engine_rates,
    fly_vertical,
    kept_tas,
    level_at,
    level_off,
)
from relguide.flying.world import FLOWN_POSITION, Declared, Guided, Recorded, World
from relguide.kernels.base.angles import wrap
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight import by_hand
from relguide.kernels.flight.flight_records import Body, Control, Drift, Limits
from relguide.kernels.flight.gusts import STATE, gust_steps
from relguide.kernels.flight.second import (
    BY_BAR,
    BY_STICK,
    GUIDED,
    PROGRAMMED,
    RECORDED,
    fly_steps,
    least_between,
)
from relguide.planning.heights import VERTICAL_MINIMUM, WHOLE_METRE, Heights
from relguide.planning.intent import LevelChange, SpeedRule
from relguide.planning.wind import Wind
from relguide.units import G0, Metre, MetrePerSecond, Radian, Second

NEW_LIMITS: Metre = 60.0
"""What an aircraft can do is computed anew once its level has changed by this [m]."""
ASKED_LESS: MetrePerSecond = 3.0
"""An aircraft that flies so much faster than is asked is to slow down [m/s]."""


class Fleet:
    """The aircraft of a world in flight: one of the few things here that change."""

    def __init__(self, world: World, step: Second, seed: int = 0) -> None:
        """All aircraft where they begin.

        Args:
            world: gives them.
            step: of the integration; a whole number of them makes a second [s].
            seed: of the gusts.
        """
        count, steps = len(world.aircraft), round(1.0 / step)
        self.world, self.step, self.steps = world, step, steps
        self.states = np.zeros((count, 7))
        self.limits = np.zeros((count, len(Limits._fields)))
        self.pilots = np.zeros(count, dtype=np.int64)
        self.controls = np.zeros((count, 3))
        self.hands = np.zeros((count, by_hand.columns(step)))
        self.whites = np.zeros((count, steps))
        self.pitches = np.zeros(count)
        """Of the sticks, −1 … 1, pulled positive."""
        self.bars = np.zeros((count, steps + 1, 2))
        self.pilot_rngs: dict[int, np.random.Generator] = {}
        """Of the pilots that follow a bar."""
        self.programs = np.zeros((count, 32, 3))
        self.lengths = np.zeros(count, dtype=np.int64)
        self.cursors = np.zeros(count, dtype=np.int64)
        self.helds = np.zeros(count)
        self.trace = np.zeros((count, steps + 1, 7))
        self.rows = slice(0, steps + 1)
        """Which rows of `trace` the last steps filled, with the one that they began from."""
        self.tallies = np.zeros((count, 4))
        self.altitudes = np.zeros((count, steps + 1))
        self.verticals = [level_at(aircraft.altitude) for aircraft in world.aircraft]
        self.limits_for = [aircraft.altitude for aircraft in world.aircraft]
        """The levels that limits were computed for [m]."""
        self.paid = [0.0] * count
        """What a climb takes off the acceleration of each, and a descent adds [m/s²]."""
        self.believed_air = world.believed_air or world.air
        self.believed_limits = [
            limits_of(aircraft, aircraft.known_airframe, self.believed_air)
            for aircraft in world.aircraft
        ]
        self.level_limits: list[Limits] = []
        """What each can do in level flight."""
        self.declared: list[Program] = []
        self.recordings: dict[int, RecordedLeader] = {}
        self.reported: dict[int, tuple[Second, RecordedLeader]] = {}
        """What those fly in a second that were reported as it began."""
        self.winds = np.zeros((count, steps + 1, 2))
        self.gusts = np.zeros((count, STATE))
        self.rng = np.random.default_rng([seed, count])
        for i, aircraft in enumerate(world.aircraft):
            wind = self._wind_at(i, aircraft.altitude)
            self.winds[i] = wind.east, wind.north
            can = limits_of(aircraft, aircraft.airframe, world.air)
            self.limits[i] = can
            self.level_limits.append(can)
            heading = wrap(aircraft.heading)
            self.states[i] = aircraft.x, aircraft.y, heading, 0.0, 0.0, aircraft.tas, 0.0
            self.controls[i] = 0.0, heading, aircraft.tas
            self.declared.append(program_of((), heading, 0.0, aircraft.tas))
            self.altitudes[i] = aircraft.altitude
            self.helds[i] = heading
            match aircraft.pilot:
                case Guided(by_hand=pilot):
                    self.pilots[i] = GUIDED
                    if pilot is not None:
                        self.hands[i] = pilot.row(step)
                        self.pilot_rngs[i] = np.random.default_rng([seed, count, 1 + i])
                        self.take_stick(i)
                case Declared(intent=intent):
                    rate = can.max_roll_rate
                    self.set_program(i, program_of(intent, heading, 0.0, aircraft.tas, rate))
                case Recorded(track=track):
                    self.pilots[i] = RECORDED
                    self.recordings[i] = recording = steps_of_track(track, wind, step)
                    self.states[i] = recording.rows[0]
                    self.altitudes[i] = recording.altitude[0]
                    self.verticals[i] = level_at(float(recording.altitude[0]))

    def set_program(self, i: int, program: Program) -> None:
        """Have an aircraft fly something else from now on."""
        self.declared[i] = program
        self.pilots[i] = PROGRAMMED
        self.recordings.pop(i, None)
        self.reported.pop(i, None)
        self.programs[i, : len(program.rows)] = program.rows
        self.lengths[i], self.cursors[i], self.helds[i] = len(program.rows), 0, program.held

    def turn(self, i: int, heading: Radian, direction: TurnChoice, bank: Radian) -> None:
        """Have an aircraft turn to a heading; what it declared before is dropped."""
        self.leave_recording(i)
        self.set_program(i, turn_program(float(self.states[i, 2]), heading, direction, bank))

    def set_speed(self, i: int, tas: MetrePerSecond) -> None:
        """Have an aircraft fly at another true airspeed [m/s]."""
        self.leave_recording(i)
        self.controls[i, 2] = tas

    def change_level(
        self, i: int, to: Metre, rate: MetrePerSecond, hold: SpeedRule = "tas"
    ) -> None:
        """Have an aircraft climb or descend to a level [m], at most so fast [m/s]."""
        self.leave_recording(i)
        tas = float(self.states[i, 5])
        self.verticals[i] = begin_change(self.verticals[i], to, rate, hold, tas, self.world.air)

    def fly_to(self, i: int, then: TrackState, t: Second) -> None:
        """Have an aircraft be somewhere in a second, where it is reported; t is now [s]."""
        self.leave_recording(i)
        body, altitude = Body(*self.states[i].tolist()), self.verticals[i].altitude
        wind = self._wind_at(i, altitude, t)
        self.pilots[i] = RECORDED
        self.reported[i] = t, steps_to(then, body, altitude, wind, self.step)

    def leave_recording(self, i: int) -> None:
        """A recorded or reported aircraft flies on under its own autopilot, as it flies now."""
        if i in self.recordings or i in self.reported:
            self.controls[i, 2] = self.states[i, 5]
            self.verticals[i] = level_off(self.verticals[i])
            heading = float(self.states[i, 2])
            self.set_program(i, program_of((), heading, 0.0, float(self.states[i, 5])))

    def recorded_until(self) -> Second:
        """When the first recording ends [s]; infinite where nothing recorded is flown."""
        ends = ((len(one.rows) - 1) * self.step for one in self.recordings.values())
        return min(ends, default=inf)

    def fly_second(self, t: Second) -> None:
        """All aircraft, one second on; `trace` then holds each step of it."""
        self.begin_second(t)
        self.fly_steps(t, 0, self.steps)

    def begin_second(self, t: Second) -> None:
        """Settle what holds for the second from t on: recordings, altitudes and winds."""
        first = round(t / self.step)
        self.trace[:, 0], self.bars[:, 0] = self.states, self.bars[:, -1]
        for i in [i for i, (since, _) in self.reported.items() if since < t]:
            self.leave_recording(i)
        self._climb(t)
        for i, recording in self.recordings.items():
            steps = np.minimum(np.arange(first, first + self.steps + 1), len(recording.rows) - 1)
            self._fly_as_given(i, recording.rows[steps], recording.altitude[steps])
        for i, (_, reported) in self.reported.items():
            self._fly_as_given(i, reported.rows, reported.altitude)
        self._blow(t)
        for i, rng in self.pilot_rngs.items():
            self.whites[i] = rng.standard_normal(self.steps)

    def _fly_as_given(self, i: int, rows: FloatArray, levels: FloatArray) -> None:
        """Have an aircraft fly rows and levels in the second that begins."""
        self.trace[i], self.altitudes[i] = rows, levels
        now = level_at(float(levels[-1]))
        self.verticals[i] = now._replace(speed=float(levels[-1] - levels[0]))

    def fly_steps(self, t: Second, begin: int, end: int) -> None:
        """All aircraft over some steps of the second from t on, once it is begun."""
        self.rows = slice(begin, end + 1)
        for i in np.flatnonzero(self.pilots == BY_STICK).tolist():
            pitch, rates = float(self.pitches[i]), self._rates(i)
            for k in range(begin, end):
                now = climb_by_stick(self.verticals[i], pitch, *rates, self.step)
                self.verticals[i], self.altitudes[i, k + 1] = now, now.altitude
        fly_steps(
            self.states, self.limits, self.pilots, self.controls, self.programs, self.lengths,
            self.cursors, self.helds, self.hands, self.whites, self.winds, t, self.step, begin,
            end, self.trace, self.bars, self.tallies,
        )  # fmt: skip

    def take_stick(self, i: int) -> None:
        """Have a crew fly a guided aircraft: its pilot follows the bar if there is one."""
        by_bar = i in self.pilot_rngs
        self.pilots[i] = BY_BAR if by_bar else BY_STICK
        self.hands[i, by_hand.STICK], self.pitches[i] = 0.0, 0.0

    def give_back(self, i: int) -> None:
        """Have the autopilot fly a guided aircraft."""
        self.pilots[i] = GUIDED

    def move_stick(self, i: int, roll: float, pitch: float) -> None:
        """Deflect a stick: it stays there. −1 … 1, to the right and pulled positive."""
        self.hands[i, by_hand.STICK], self.pitches[i] = roll, pitch

    def has_pilot(self, i: int) -> bool:
        """Whether a modelled pilot flies an aircraft while its autopilot does not."""
        return i in self.pilot_rngs

    def is_by_hand(self, i: int) -> bool:
        """Whether a crew flies an aircraft."""
        return bool(self.pilots[i] in (BY_STICK, BY_BAR))

    def is_by_stick(self, i: int) -> bool:
        """Whether a crew moves the stick of an aircraft."""
        return bool(self.pilots[i] == BY_STICK)

    def _climb(self, t: Second) -> None:
        """The altitudes of the second from t on, where they change, and the speeds that go with it.

        A guided aircraft pays for a climb with thrust, and gains by a descent: V̇ less g ḣ/V.
        """
        for i in np.flatnonzero(self.pilots != RECORDED).tolist():
            if self.pilots[i] == PROGRAMMED:
                for at, change in self.declared[i].levels:
                    if t - 1.0 < at <= t or (t == 0.0 and at <= 0.0):
                        self.change_level(i, change.to_altitude, change.rate, change.hold)
            now, aircraft = self.verticals[i], self.world.aircraft[i]
            rests = self.altitudes[i, 0] == now.altitude == self.altitudes[i, -1]
            by_stick = self.is_by_stick(i)
            if rests and (now.speed == 0.0 if by_stick else now.is_level):
                continue
            air, guided = self.world.air, isinstance(aircraft.pilot, Guided)
            if guided and abs(now.altitude - self.limits_for[i]) > NEW_LIMITS:
                self._limit(i, now.altitude)
            limits, tas = self.level_limits[i], float(self.states[i, 5])
            climb, descent = aircraft.airframe.max_climb, aircraft.airframe.max_descent
            if guided:
                climb, descent = self._rates(i)
            if by_stick:  # as it flies now: what the stick makes of it comes step by step
                altitudes = now.altitude + now.speed * self.step * np.arange(self.steps + 1.0)
            else:
                now, altitudes = fly_vertical(now, climb, descent, self.steps, self.step)
            self.verticals[i], self.altitudes[i] = now, altitudes
            if self.pilots[i] == PROGRAMMED and not now.is_level and now.hold != "tas":
                self.controls[i, 2] = kept_tas(now, aircraft.airframe, air)
            if guided:
                self.paid[i] = paid = float(G0 * (altitudes[-1] - altitudes[0]) / tas)
                self.limits[i] = limits._replace(
                    climb_0=limits.climb_0 - paid, idle_0=limits.idle_0 - paid
                )

    def _rates(self, i: int) -> tuple[MetrePerSecond, MetrePerSecond]:
        """The highest rates of climb and of descent of a guided aircraft now [m/s]."""
        tas = float(self.states[i, 5])
        slowing = bool(self.controls[i, 2] < tas - ASKED_LESS)
        airframe = self.world.aircraft[i].airframe
        return engine_rates(self.level_limits[i], airframe, tas, slowing=slowing)

    def commanded_climb(self, i: int) -> MetrePerSecond:
        """The rate of climb that is commanded of a guided aircraft now [m/s]."""
        return commanded_climb(self.verticals[i], *self._rates(i), self.step)

    def climb(self, i: int) -> MetrePerSecond:
        """How fast an aircraft climbs now [m/s]."""
        return self.verticals[i].speed

    def commanded_bank(self, i: int, k: int | None = None) -> tuple[Radian, Radian]:
        """Commanded bank and roll bar of a guided aircraft, at a step or at the last one [rad]."""
        bank, bar = self.bars[i, -1 if k is None else k].tolist()
        return bank, bar

    def react(self, i: int, t: Second, after: Second) -> None:
        """Have the pilot of an aircraft answer the bar a while after t, if it looks at it now.

        What comes while it is reading puts nothing off.
        """
        if self.hands[i, by_hand.REACTS_AT] <= t:
            self.hands[i, by_hand.REACTS_AT] = t + after

    def _limit(self, i: int, altitude: Metre) -> None:
        """What a guided aircraft can do at another level, in truth and as it is believed."""
        here = replace(self.world.aircraft[i], altitude=altitude)
        self.limits_for[i] = altitude
        self.level_limits[i] = limits_of(here, here.airframe, self.world.air)
        braking = self.believed_limits[i].braking
        believed = limits_of(here, here.known_airframe, self.believed_air)
        self.believed_limits[i] = believed._replace(braking=braking)

    def believed(self, i: int) -> Limits:
        """What an aircraft believes that it can do: in a descent it slows down less."""
        limits = self.believed_limits[i]
        if self.paid[i] >= 0.0:
            return limits
        return limits._replace(idle_0=limits.idle_0 - self.paid[i])

    def changes_level(self, i: int) -> bool:
        """Whether an aircraft climbs or descends now."""
        return self.verticals[i].speed != 0.0

    def heights(self, i: int, t: Second, declared: Program | None = None) -> Heights:
        """The altitude of an aircraft, and its changes of level from now on.

        Args:
            i: which.
            t: flight time [s].
            declared: what it declared, if that is known: its changes to come are in it.
        """
        now = self.verticals[i]
        changes = []
        if not now.is_level and self.pilots[i] != RECORDED:
            changes.append(LevelChange(at=0.0, to_altitude=now.to, rate=now.rate))
        for at, change in () if declared is None else declared.levels:
            if at > t - 1.0 and not (changes and changes[0].to_altitude == change.to_altitude):
                to, rate = change.to_altitude, change.rate
                changes.append(LevelChange(at=max(at - t, 0.0), to_altitude=to, rate=rate))
        return Heights(altitude=now.altitude, changes=tuple(changes))

    def _wind_at(self, i: int, altitude: Metre, t: Second = 0.0) -> Wind:
        """The wind where an aircraft is, without gusts."""
        x, y = self.states[i, :2].tolist()
        return self.world.air.wind_at(x, y, altitude, t)

    def _blow(self, t: Second) -> None:
        """The winds of the second from t on, which no longer are what they were at the start."""
        air = self.world.air
        if air.profile is not None:
            shares = np.linspace(0.0, 1.0, self.steps + 1)[:, None]
            for i, altitudes in enumerate(self.altitudes):
                ends = [self._wind_at(i, float(altitudes[k]), t) for k in (0, -1)]
                before, after = (np.array([wind.east, wind.north]) for wind in ends)
                self.winds[i] = before + shares * (after - before)
        if air.gusts == 0.0:
            return
        for i, (_, _, heading, _, _, tas, _) in enumerate(self.states.tolist()):
            white = self.rng.standard_normal((self.steps + 1, 2))
            along, across = gust_steps(self.gusts[i], air.gusts, tas, self.step, white).T
            if air.profile is None:
                wind = air.wind
                self.winds[i] = wind.east, wind.north
            self.winds[i, :, 0] += along * sin(heading) + across * cos(heading)
            self.winds[i, :, 1] += along * cos(heading) - across * sin(heading)

    def drift(self, i: int) -> Drift:
        """The wind that moves an aircraft now, gusts and all."""
        return Drift(*self.winds[i, -1].tolist())

    def blew(self, i: int) -> Drift:
        """The wind that moved an aircraft in the last second."""
        return Drift(*self.winds[i, :-1].mean(axis=0).tolist())

    def control(self, i: int, control: Control) -> None:
        """What a guided aircraft is to fly for the next second."""
        self.controls[i] = control

    def body(self, i: int) -> Body:
        """An aircraft now."""
        return Body(*self.states[i].tolist())

    def wind(self, i: int, k: int | None = None) -> Wind:
        """The wind that moves an aircraft now, or did at a step of the last second."""
        east, north = self.winds[i, -1 if k is None else k].tolist()
        return Wind(east=east, north=north)

    def state(self, i: int, k: int | None = None) -> AircraftState:
        """An aircraft now, or at a step of the last second, as documents show it."""
        row = self.states[i] if k is None else self.trace[i, k]
        x, y, heading, bank, roll_rate, tas, _ = row.tolist()
        altitude = float(self.altitudes[i, -1 if k is None else k])
        return AircraftState(x, y, wrap(heading), bank, roll_rate, tas, altitude)

    def apart(self, i: int, j: int) -> Metre:
        """How far apart two aircraft are now [m]."""
        one, other = self.states[i], self.states[j]
        return hypot(one[0] - other[0], one[1] - other[1])

    def counted_apart(self, i: int, j: int) -> Metre:
        """The same; infinite if 1,000 ft keep both apart [m]."""
        return inf if bool(self.by_height(i, j)[-1]) else self.apart(i, j)

    def by_height(self, i: int, j: int) -> NDArray[np.bool_]:
        """Whether 1,000 ft kept two aircraft apart, at each of the steps last flown."""
        apart = np.abs(self.altitudes[i, self.rows] - self.altitudes[j, self.rows])
        kept: NDArray[np.bool_] = apart >= VERTICAL_MINIMUM - WHOLE_METRE
        return kept

    def least_apart(self, i: int, j: int) -> Metre:
        """How near two aircraft came in the steps last flown, where height did not keep them apart.

        Infinite if it did all the while [m].
        """
        kept = self.by_height(i, j)
        own, other = self.trace[i, self.rows], self.trace[j, self.rows]
        if not kept.any():
            return least_between(own, other)[0]
        apart = np.hypot(*(own[~kept, :2] - other[~kept, :2]).T)
        return float(np.min(apart, initial=inf))

    def beyond_edge(self) -> str:
        """The ident of an aircraft about to leave the plane; empty if there is none."""
        edge = FLOWN_POSITION.high
        for aircraft, (x, y) in zip(self.world.aircraft, self.states[:, :2].tolist(), strict=True):
            if not (abs(x) <= edge and abs(y) <= edge):
                return aircraft.ident
        return ""
