"""RecordedTrack: where a recorded aircraft was, smooth, as a leader to fly behind.

`recordings/` makes them from what people have: files of several forms, and the samples of the
package traffic.
"""

from dataclasses import dataclass, field
from math import atan2, hypot
from typing import NamedTuple, TypeVar

import numpy as np

from relguide.flying.spline import Array
from relguide.kernels.base.angles import wrap
from relguide.planning.frames import LocalPlane
from relguide.units import Metre, MetrePerSecond, Radian, Second

U = TypeVar("U", float, Array)


def hermite(u: U) -> tuple[U, U, U, U, U, U]:
    """The cubic Hermite basis of a piece at u, 0 … 1.

    Returns:
        the weights of the first place, the first velocity and the last one (that of the last place
        is what the first leaves of 1), then the slopes of these three.
    """
    a, b, c = (1.0 - u) ** 2 * (1.0 + 2.0 * u), u * (1.0 - u) ** 2, u * u * (u - 1.0)
    da, db, dc = 6.0 * u * (u - 1.0), (3.0 * u - 1.0) * (u - 1.0), u * (3.0 * u - 2.0)
    return a, b, c, da, db, dc


class TrackState(NamedTuple):
    """Where a recorded aircraft is, over the ground."""

    x: Metre
    """East of the origin [m]."""
    y: Metre
    """North of the origin [m]."""
    track: Radian
    """Direction of the ground velocity, clockwise from north [rad], in [0, 2π)."""
    ground_speed: MetrePerSecond
    altitude: Metre


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RecordedTrack:
    """The airborne part of a recorded track, smooth, in a plane that touches the earth near it.

    Examples:
        >>> from pathlib import Path
        >>> _ = Path("one.scn").write_text("00:00:00>CRE KL204 A320 52.0,4.0 90 FL310 280")
        >>> round(rg.load_track("one.scn").state_at(60.0).ground_speed)  # [m/s]
        229
    """

    ident: str
    """Callsign, or the 24-bit address where there is none."""
    aircraft_type: str
    """ICAO type designator, empty when not recorded."""
    origin: LocalPlane
    """Where x = y = 0 is: the median of the positions."""
    t: Array
    """Even steps from 0 [s]."""
    x: Array
    """East [m]."""
    y: Array
    """North [m]."""
    track: Array
    """Direction of the ground velocity, clockwise from north [rad]; continuous, not wrapped."""
    ground_speed: Array
    """Speed over the ground [m/s]."""
    altitude: Array
    """As recorded [m], taken for pressure altitude."""
    start: Second = 0.0
    """When it begins, since 1970 UTC [s]."""
    taken: str = ""
    """Which stretch of the recording it is and what was left out, in sentences."""
    _knots: list[tuple[float, float, float, float, float]] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Refuse arrays that do not make a track."""
        columns = (self.t, self.x, self.y, self.track, self.ground_speed, self.altitude)
        if len(self.t) < 2 or any(column.shape != self.t.shape for column in columns):
            raise ValueError("A track needs two points or more, and all arrays of one length.")
        if not all(np.all(np.isfinite(column)) for column in columns):
            raise ValueError("A track must hold finite numbers only.")
        if not np.allclose(np.diff(self.t, prepend=-self.t[1]), self.t[1]):
            raise ValueError("A track's times must begin at 0 and rise in even steps.")
        east, north = self.ground_speed * np.sin(self.track), self.ground_speed * np.cos(self.track)
        knots = np.column_stack([self.x, self.y, east, north, self.altitude])
        # plain floats: the closed loop asks 20 times a second of flight
        object.__setattr__(self, "_knots", list(map(tuple, knots.tolist())))

    @property
    def duration(self) -> Second:
        """How long it lasts [s]."""
        return float(self.t[-1])

    @property
    def end(self) -> Second:
        """When it ends, since 1970 UTC [s]."""
        return self.start + self.duration

    def sample(self, t: Array) -> tuple[Array, Array, Array, Array, Array]:
        """As `state_at`, at many times of the recording at once.

        Args:
            t: times from 0 to `duration` [s]. shape (n,)

        Returns:
            east, north [m], ground velocity east, north [m/s], and altitude [m]. shape (n,) each
        """
        knots, step = np.array(self._knots), float(self.t[1])
        i = np.minimum((t / step).astype(np.intp), len(knots) - 2)
        u = t / step - i
        x0, y0, east0, north0, altitude0 = knots[i].T
        x1, y1, east1, north1, altitude1 = knots[i + 1].T
        a, b, c, da, db, dc = hermite(u)
        return (
            a * x0 + (1.0 - a) * x1 + step * (b * east0 + c * east1),
            a * y0 + (1.0 - a) * y1 + step * (b * north0 + c * north1),
            da * (x0 - x1) / step + db * east0 + dc * east1,
            da * (y0 - y1) / step + db * north0 + dc * north1,
            altitude0 + u * (altitude1 - altitude0),
        )

    def state_at(self, t: float) -> TrackState:
        """Where it is at time t [s]; before its start and after its end it flies straight on.

        Cubic Hermite between the points: position and velocity are continuous.

        Returns:
            east, north [m], track clockwise from north [rad], ground speed [m/s], altitude [m].
        """
        knots, step = self._knots, float(self.t[1])
        inside = min(max(t, 0.0), self.duration)
        i = min(int(inside / step), len(knots) - 2)
        x0, y0, east0, north0, altitude0 = knots[i]
        x1, y1, east1, north1, altitude1 = knots[i + 1]
        u = inside / step - i
        a, b, c, da, db, dc = hermite(u)
        east = da * (x0 - x1) / step + db * east0 + dc * east1
        north = da * (y0 - y1) / step + db * north0 + dc * north1
        beyond = t - inside
        return TrackState(
            x=a * x0 + (1.0 - a) * x1 + step * (b * east0 + c * east1) + east * beyond,
            y=a * y0 + (1.0 - a) * y1 + step * (b * north0 + c * north1) + north * beyond,
            track=wrap(atan2(east, north)),
            ground_speed=hypot(east, north),
            altitude=altitude0 + u * (altitude1 - altitude0),
        )
