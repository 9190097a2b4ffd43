"""Scenarios of BlueSky, `.scn`: aircraft made by CRE and told HDG, ALT, VS, SPD and DEL, flown.

A line is `00:01:30.00>HDG KL204 270`; the words may be parted by commas, and the callsign may come
first. As BlueSky does, an aircraft banks by 25° in still air, climbs at 1,500 ft/min if not told
otherwise, and keeps its calibrated airspeed or Mach number. Whatever else an aircraft is told, such
as a route, is refused in a sentence; what is told to no aircraft of ours (PAN, ASAS, …) is passed
over. Times are of 1 January 1970.
"""

import re
from dataclasses import dataclass, field, replace
from math import copysign, cos, inf, radians, remainder, sin, tan

from relguide.flying.air import STANDARD_AIR
from relguide.flying.recordings.reports import Report, Reports, reports_of
from relguide.units import DEG, FT, G0, KT, Metre, MetrePerSecond, Radian, Second

LASTS: Second = 900.0
"""How long an aircraft flies on after its last command."""
BANK: Radian = 25.0 * DEG
CLIMB: MetrePerSecond = 1500.0 * FT / 60.0
ACCELERATION = 0.5
"""Of speed changes [m/s²]."""
EARTH: Metre = 6_378_137.0
FLATTENED = 0.00669437999014
"""Eccentricity of WGS84, squared."""
LINE = re.compile(r"^\s*(\d+):(\d+):(\d+(?:\.\d*)?)\s*>\s*(.*?)\s*$")
TOLD = ("HDG", "ALT", "VS", "SPD", "DEL")
SYNONYMS = {"SPEED": "SPD", "DELETE": "DEL", "HEADING": "HDG", "TURN": "HDG"}
MADE = "CRE CALLSIGN TYPE LAT LON HDG ALT SPD"


@dataclass(frozen=True, slots=True)
class _Aircraft:
    """One aircraft as it flies."""

    t: Second
    lat: Radian
    lon: Radian
    heading: Radian
    altitude: Metre
    speed: float
    """Calibrated airspeed [m/s], or a Mach number if below 1."""
    to_heading: Radian
    to_altitude: Metre
    to_speed: float
    climb: MetrePerSecond = CLIMB

    @property
    def tas(self) -> MetrePerSecond:
        return _tas(self.speed, self.altitude)


@dataclass(slots=True)
class _Story:
    """What one aircraft is told, each thing at its time."""

    aircraft_type: str
    made: _Aircraft
    told: list[tuple[Second, str, float]] = field(default_factory=list)


def read_scn(text: str, source: str) -> Reports:
    """The reports of all aircraft of a scenario, one a second.

    Raises:
        ValueError: naming the line that cannot be flown, and why.
    """
    stories = dict[str, _Story]()
    for number, line in enumerate(text.splitlines(), 1):
        timed = LINE.match(line)
        if timed is None:
            if line.strip() and not line.lstrip().startswith("#"):
                raise ValueError(f"{source}, line {number}: a line begins with 00:00:00.00>.")
            continue
        hours, minutes, seconds, command = timed.groups()
        t = int(hours) * 3600.0 + int(minutes) * 60.0 + float(seconds)
        try:
            _hear(t, [word for word in re.split(r"[\s,]+", command.upper()) if word], stories)
        except ValueError as error:
            raise ValueError(f"{source}, line {number}: {error}") from None
    if not stories:
        raise ValueError(f"{source} makes no aircraft: none of its lines is {MADE}.")
    rows = [row for name, story in stories.items() for row in _flown(name, story)]
    return reports_of(rows)


def _hear(t: Second, words: list[str], stories: dict[str, _Story]) -> None:
    """Take one command in."""
    if not words:
        return
    # both ways round: HDG KL204 270, and KL204 HDG 270
    if words[0] in stories and len(words) > 1:
        words[:2] = [words[1], words[0]]
    command = SYNONYMS.get(words[0], words[0])
    if command == "CRE":
        if len(words) != 8:
            raise ValueError(f"a new aircraft is {MADE}.")
        _, name, kind, lat, lon, heading, altitude, speed = words
        if name in stories:
            raise ValueError(f"{name} is made twice.")
        made = _Aircraft(
            t=t,
            lat=_degrees(lat, "NS") * DEG,
            lon=_degrees(lon, "EW") * DEG,
            heading=_number(heading) * DEG,
            altitude=_altitude(altitude),
            speed=_speed(speed),
            to_heading=_number(heading) * DEG,
            to_altitude=_altitude(altitude),
            to_speed=_speed(speed),
        )
        stories[name] = _Story(kind, made)
        return
    name = next((word for word in words[1:2] if word in stories), "")
    if not name:
        return
    if command not in TOLD:
        raise ValueError(
            f"{name} is told {words[0]}: of recorded leaders only CRE, {', '.join(TOLD)} are flown."
        )
    value = 0.0
    if command != "DEL":
        if len(words) < 3:
            raise ValueError(f"{words[0]} {name} lacks its number.")
        value = {"HDG": _heading, "ALT": _altitude, "VS": _climb, "SPD": _speed}[command](words[2])
    stories[name].told.append((t, command, value))
    if command == "ALT" and len(words) > 3:
        stories[name].told.append((t, "VS", _climb(words[3])))


def _flown(name: str, story: _Story) -> list[Report]:
    """An aircraft a second at a time, from where it is made to its end."""
    now, rows = story.made, []
    told = sorted(story.told, key=lambda one: one[0])
    end = next((t for t, command, _ in told if command == "DEL"), inf)
    end = min(end, max([now.t, *(t for t, _, _ in told)]) + LASTS)
    while now.t <= end:
        while told and told[0][0] <= now.t:
            _, command, value = told.pop(0)
            match command:
                case "HDG":
                    now = replace(now, to_heading=value)
                case "ALT":
                    now = replace(now, to_altitude=value)
                case "VS":
                    now = replace(now, climb=abs(value))
                case "SPD":
                    # the speed flown, counted as the new one is
                    now = replace(now, to_speed=value, speed=_recounted(now, value))
        rows.append(
            Report(
                address="",
                callsign=name,
                aircraft_type=story.aircraft_type,
                t=now.t,
                lat_deg=now.lat / DEG,
                lon_deg=now.lon / DEG,
                altitude=now.altitude,
                ground_speed=now.tas,
                track_deg=now.heading / DEG,
                on_ground=0.0,
            )
        )
        now = _a_second_later(now)
    return rows


def _a_second_later(now: _Aircraft) -> _Aircraft:
    tas = now.tas
    rate = G0 * tan(BANK) / tas
    left = remainder(now.to_heading - now.heading, radians(360.0))
    turned = copysign(min(abs(left), rate), left)
    course = now.heading + 0.5 * turned
    bent = 1.0 - FLATTENED * sin(now.lat) ** 2
    along = EARTH * (1.0 - FLATTENED) / bent**1.5
    across = EARTH / bent**0.5 * cos(now.lat)
    rise = now.to_altitude - now.altitude
    gain = now.to_speed - now.speed
    most = ACCELERATION * (now.speed / tas)
    return replace(
        now,
        t=now.t + 1.0,
        lat=now.lat + tas * cos(course) / along,
        lon=now.lon + tas * sin(course) / across,
        heading=now.heading + turned,
        altitude=now.altitude + copysign(min(abs(rise), now.climb), rise),
        speed=now.speed + copysign(min(abs(gain), most), gain),
    )


def _recounted(now: _Aircraft, wanted: float) -> float:
    """The present speed as a Mach number if one is wanted, else as a calibrated airspeed."""
    if wanted < 1.0:
        return STANDARD_AIR.mach(now.tas, now.altitude)
    return STANDARD_AIR.cas_from_tas(now.tas, now.altitude)


def _tas(speed: float, altitude: Metre) -> MetrePerSecond:
    if speed < 1.0:
        return STANDARD_AIR.tas_from_mach(speed, altitude)
    return STANDARD_AIR.tas_from_cas(speed, altitude)


def _number(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        raise ValueError(f"{word!r} is not a number.") from None


def _degrees(word: str, sides: str) -> float:
    """A latitude or longitude: `52.3`, `N52.3`."""
    if word[:1] in sides:
        return _degrees(word[1:], "") * (1.0 if word[0] == sides[0] else -1.0)
    try:
        return float(word)
    except ValueError:
        raise ValueError(f"{word!r} is no latitude or longitude in degrees.") from None


def _heading(word: str) -> Radian:
    return _number(word) * DEG


def _altitude(word: str) -> Metre:
    """`FL310`, or feet."""
    if word.startswith("FL"):
        return _number(word[2:]) * 100.0 * FT
    return _number(word) * FT


def _climb(word: str) -> MetrePerSecond:
    return _number(word) * FT / 60.0


def _speed(word: str) -> float:
    """A Mach number, `.78` or `M78`, or knots of calibrated airspeed as m/s."""
    value = _number("." + word[1:].lstrip(".")) if word.startswith("M") else _number(word)
    if value <= 0.0:
        raise ValueError(f"a speed must be above 0, not {word}.")
    return value if value < 1.0 else value * KT
