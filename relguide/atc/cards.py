"""Clearances and tracks as outsiders read them, and as they are on record."""

import numpy as np

from relguide.atc.documents import ClearanceCard, TrackCard
from relguide.atc.life import Clearance
from relguide.atc.track import Track
from relguide.kernels.base.roots import FloatArray


def card_of(clearance: Clearance) -> ClearanceCard:
    """All of a clearance, for JSON."""
    request = clearance.request
    by_time = request.spacing_type == "time"
    return ClearanceCard(
        id=clearance.id,
        sky=clearance.sky,
        flight_id=clearance.flight_id,
        aircraft=request.ident,
        traffic_id=request.leader,
        spacing_type=request.spacing_type,
        slot_distance=0.0 if by_time else request.spacing,
        spacing_time=request.spacing if by_time else 0.0,
        min_separation=request.min_separation,
        word=request.word,
        text=clearance.text,
        state=clearance.state,
        due=clearance.due,
        joins=request.joins,
        route=track_card(request.path),
        leader_route=track_card(request.leader_path),
        bank=request.bank,
        max_bank=request.max_bank,
        validation=() if clearance.validation is None else (clearance.validation,),
        deviations=clearance.deviations,
        history=clearance.history,
        auto_answer=clearance.auto_answer,
    )


def track_card(track: Track) -> TrackCard:
    """A track in columns. Heights are left out unless all of them are known."""
    known = bool(np.all(np.isfinite(track.low)) and np.all(np.isfinite(track.high)))
    return TrackCard(
        t=_column(track.t),
        x=_column(track.x),
        y=_column(track.y),
        altitude=_column(0.5 * (track.low + track.high)) if known else (),
        low=_column(track.low) if known else (),
        high=_column(track.high) if known else (),
        error=track.error,
    )


def _column(values: FloatArray) -> tuple[float, ...]:
    return tuple(values.tolist())
