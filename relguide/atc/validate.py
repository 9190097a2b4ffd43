"""validate(manoeuvre, picture, now): whether a manoeuvre may be cleared amid all that is known.

All findings are given at once, each in the words of data link and in a sentence with what would
help. It is automation's advice: the controller answers. It holds while everybody stays within the
thresholds of conformance (`AtcSettings`), as these are what it adds to every track.
"""

from collections.abc import Iterator
from math import inf, nan
from typing import NamedTuple

from relguide.atc.airspaces import entries
from relguide.atc.bounds import NONE, cleared_stray, stray_of
from relguide.atc.documents import Finding, PairCard, PlaceAt, ReasonCode, ValidationCard, Verdict
from relguide.atc.leading import disagreement, lost_place
from relguide.atc.phraseology import STANDBY, spacing_text, unable_text
from relguide.atc.picture import Picture, Seen
from relguide.atc.probe import Approach, Other, probe
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.atc.track import Track
from relguide.atc.tracks import straight_track
from relguide.planning.phrases import distance
from relguide.units import DEG, Metre, Second

CLEAR_SHOWN = 8
"""So many of those that are clear are shown beside those that are not."""


class _Known(NamedTuple):
    """Another aircraft as it was probed."""

    seen: Seen
    other: Other
    leads: bool
    intends: bool


def validate(
    manoeuvre: Manoeuvre, picture: Picture, now: Second, settings: AtcSettings | None = None
) -> ValidationCard:
    """Whether a manoeuvre keeps clear of everybody and of closed airspace, and can be flown.

    Others keep `settings.minimum`, the leader the manoeuvre's own d_min; the two are guided
    relative to each other, so that no bound is added between them but the errors of both tracks.

    Args:
        manoeuvre: what is asked for, in the plane and the clock of the picture.
        picture: all that fly, and what is closed. Whoever asks is left out.
        now: in that clock [s].
        settings: minima, bounds and times.

    Returns:
        the verdict with all findings; without alternatives, see `alternatives.suggest`.
    """
    settings = settings or AtcSettings()
    begin, end = horizon(manoeuvre, now, settings)
    own = manoeuvre.path
    stray = cleared_stray(own, settings)
    known = _known(manoeuvre, picture, end, stray, settings)
    approaches = probe(
        own, [one.other for one in known], begin=begin, end=end, vertical=settings.vertical_minimum
    )
    pairs = [(_pair(own, known, approach), approach) for approach in approaches]
    findings = (
        *_stale(picture, now, settings),
        *_expired(manoeuvre, now),
        *_beyond_horizon(manoeuvre, now, settings),
        *_separation(pairs, known, manoeuvre, now),
        *_airspace(manoeuvre, picture, (begin, end), stray, now, settings),
        *_performance(manoeuvre, end, settings),
        *_leader(manoeuvre, picture, now, end, settings),
    )
    verdict = _verdict(findings)
    return ValidationCard(
        verdict=verdict,
        findings=findings,
        pairs=_listed(pairs),
        alternatives=(),
        valid_until=now + (settings.valid_for if verdict == "acceptable" else 0.0),
        computed=now,
        picture_as_of=picture.as_of,
        aircraft=len(known),
    )


def horizon(manoeuvre: Manoeuvre, now: Second, settings: AtcSettings) -> tuple[Second, Second]:
    """From when until when a manoeuvre is looked at [s]; once it has joined, ever further on."""
    begin = max(now, manoeuvre.path.begin)
    return begin, min(max(manoeuvre.joins, now) + settings.followed, now + settings.horizon)


def _known(
    manoeuvre: Manoeuvre, picture: Picture, end: Second, stray: Metre, settings: AtcSettings
) -> list[_Known]:
    """All others, each with what is to be kept and what may differ."""
    known = []
    for seen in picture.aircraft:
        if seen.ident == manoeuvre.ident:
            continue
        if seen.ident == manoeuvre.leader:
            track = seen.path or manoeuvre.leader_path
            other = Other(track=track, minimum=manoeuvre.min_separation, stray=NONE)
            known.append(_Known(seen, other, leads=True, intends=True))
            continue
        track = seen.path or straight_track(seen, until=end, settings=settings)
        other = Other(
            track=track,
            minimum=settings.minimum,
            stray=stray_of(seen, settings, stray),
            fan=settings.fan if seen.path is None else nan,
        )
        known.append(_Known(seen, other, leads=False, intends=seen.path is not None))
    return known


def _pair(own: Track, known: list[_Known], approach: Approach) -> PairCard:
    one = known[approach.number]
    other, minimum = one.other.track, one.other.minimum
    least = approach.least
    certain = least < minimum
    place, there = own.place(approach.at), other.place(approach.at)
    return PairCard(
        ident=one.seen.ident,
        at=approach.at,
        least=least,
        proved_above=max(least - own.error - other.error, 0.0),
        bound=approach.bound,
        minimum=minimum,
        vertical=(approach.vertical,) if approach.vertical > 0.0 else (),
        certainty="certain" if certain else "possible" if approach.margin < 0.0 else "clear",
        own=PlaceAt(t=approach.at, x=place[0], y=place[1]),
        other=PlaceAt(t=approach.at, x=there[0], y=there[1]),
        since=approach.since,
        until=approach.until,
    )


def _listed(pairs: list[tuple[PairCard, Approach]]) -> tuple[PairCard, ...]:
    """Those that are lost and the nearest of the others, least margin first."""
    ordered = sorted(pairs, key=lambda pair: pair[1].margin)
    lost = sum(approach.margin < 0.0 for _, approach in ordered)
    return tuple(card for card, _ in ordered[: lost + CLEAR_SHOWN])


def _separation(
    pairs: list[tuple[PairCard, Approach]], known: list[_Known], manoeuvre: Manoeuvre, now: Second
) -> Iterator[Finding]:
    """One finding for each aircraft that is, or may be, too near; soonest first."""
    lost = [pair for pair in pairs if pair[1].margin < 0.0]
    for card, approach in sorted(lost, key=lambda pair: pair[1].since):
        one = known[approach.number]
        near = f"{distance(card.least)} from {card.ident} {_in(card.at, now)}"
        least = f"{distance(card.minimum)} is to be kept"
        reason: ReasonCode = "separation"
        if card.certainty == "certain":
            message = f"It comes to {near}, and {least}."
            help_ = "A larger D, a later start or another path would help."
            if not one.leads:
                help_ = "A later start, another path or another level would help."
        elif not one.intends:
            reason = "traffic_without_intent"
            message = (
                f"{card.ident} has not said what it intends: by a turn it could come too near from "
                f"{approach.since - now:.0f} s on. Straight on it comes to "
                f"{distance(card.least)} {_in(card.at, now)}."
            )
            help_ = f"The intent of {card.ident} would help, or a later start."
        else:
            spare = distance(card.bound + card.least - card.proved_above)
            message = (
                f"It is expected {near}; {least}, and {spare} more for what both may stray from "
                "their tracks."
            )
            help_ = "A later start, another path or another level would help."
        yield _finding(reason, f"{message} {help_}", card.ident)


def _airspace(
    manoeuvre: Manoeuvre, picture: Picture, looked_at: tuple[Second, Second], stray: Metre,
    now: Second, settings: AtcSettings,
) -> Iterator[Finding]:  # fmt: skip
    begin, end = looked_at
    for entry in entries(
        manoeuvre.path, picture.airspaces, begin=begin, end=end, bound=stray,
        spare=settings.level.caution,
    ):  # fmt: skip
        when = _in(entry.at, now)
        message = f"It enters {entry.ident}, which is closed, {when}."
        if entry.least > 0.0:
            message = (
                f"It comes to {distance(entry.least)} from {entry.ident}, which is closed, {when}; "
                f"{distance(stray + manoeuvre.path.error)} is kept for what it may stray."
            )
        yield _finding(
            "airspace", f"{message} Another path, or a start that is later, would help.",
            entry.ident,
        )  # fmt: skip


def _performance(manoeuvre: Manoeuvre, end: Second, settings: AtcSettings) -> Iterator[Finding]:
    bank, has = manoeuvre.bank, manoeuvre.max_bank
    if bank > has > 0.0 and bank - has > 1e-6:  # rounding
        yield _finding(
            "bank",
            f"Its turns need {bank / DEG:.0f}° of bank, and {manoeuvre.ident} has {has / DEG:.0f}°."
            " A plan for that bank would help.",
        )
    lost = lost_place(manoeuvre, min(end, manoeuvre.path.end), settings)
    if lost:
        yield _finding(
            "speed",
            f"It does not keep its place: {lost}. A speed that {manoeuvre.ident} and "
            f"{manoeuvre.leader} both can fly would help.",
        )


def _leader(
    manoeuvre: Manoeuvre, picture: Picture, now: Second, end: Second, settings: AtcSettings
) -> Iterator[Finding]:
    leader = picture.find(manoeuvre.leader)
    if leader is None:
        yield _finding(
            "leader_disagrees",
            f"{manoeuvre.leader} is not in the picture. It must be seen to be followed.",
            manoeuvre.leader,
        )
        return
    told = disagreement(manoeuvre.leader_path, leader, max(now, leader.t), end, settings)
    if told:
        yield _finding(
            "leader_disagrees",
            f"{leader.ident} does not fly what this was planned on: it {told}. "
            "A plan on its present intent would help.",
            leader.ident,
        )


def _stale(picture: Picture, now: Second, settings: AtcSettings) -> Iterator[Finding]:
    age = now - picture.as_of
    if age > settings.stale:
        yield Finding(
            reason="stale_picture",
            text=STANDBY,
            message=f"The picture is {age:.0f} s old, and nothing is validated on one older than "
            f"{settings.stale:.0f} s. It is validated as soon as a newer one comes.",
        )


def _expired(manoeuvre: Manoeuvre, now: Second) -> Iterator[Finding]:
    ended = now - manoeuvre.path.end
    if ended >= 0.0:
        yield _finding(
            "expired", f"Its path ended {ended:.0f} s ago. A plan that begins now would help."
        )


def _beyond_horizon(manoeuvre: Manoeuvre, now: Second, settings: AtcSettings) -> Iterator[Finding]:
    joins_in = manoeuvre.joins - now
    if joins_in > settings.horizon:
        spacing = spacing_text(manoeuvre.spacing_type, manoeuvre.spacing)
        yield _finding(
            "horizon",
            f"It is {spacing} behind {manoeuvre.leader} in {joins_in / 60.0:.0f} min, and traffic "
            f"is predicted for {settings.horizon / 60.0:.0f} min. A request in "
            f"{(joins_in - settings.horizon) / 60.0:.0f} min would help, or a faster plan.",
        )


def _verdict(findings: tuple[Finding, ...]) -> Verdict:
    if not findings:
        return "acceptable"
    waits = any(finding.reason == "stale_picture" for finding in findings)
    return "standby" if waits else "unable"


def _finding(reason: ReasonCode, message: str, *idents: str) -> Finding:
    return Finding(reason=reason, text=unable_text(reason, idents), message=message, idents=idents)


def _in(t: Second, now: Second) -> str:
    return "now" if t - now < 0.5 else f"in {t - now:.0f} s"


def least_from_others(card: ValidationCard, leader: str) -> Metre:
    """How near a manoeuvre comes to any aircraft but its leader [m]; infinite if to none."""
    return min((pair.least for pair in card.pairs if pair.ident != leader), default=inf)
