"""A flight that is held whole, as a notebook shows it."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from relguide.flying.documents import Document, FlightEnded, FlightStarted
from relguide.pictures.picture import Picture, picture
from relguide.planning.extras import MissingExtra, need
from relguide.units import Second

if TYPE_CHECKING:
    from relguide.pictures.widget import NavigationDisplay


@dataclass(frozen=True, slots=True, repr=False, init=False)
class Flight:
    """The documents of a flight: `Flight(fly(scenario, plan))`, or `Flight(replay(file))`.

    Examples:
        >>> flight = rg.Flight(rg.fly(rg.scenario("fig_6b"), rg.plan, sample_period=1.0))
        >>> round(flight.join_time)  # [s]
        916
    """

    documents: tuple[Document, ...]

    def __init__(self, documents: Iterable[Document]) -> None:
        object.__setattr__(self, "documents", tuple(documents))
        if not self.documents:
            raise ValueError("A flight has documents: the first is FlightStarted.")

    @property
    def duration(self) -> Second:
        """Flight time of the last document [s]."""
        return self.documents[-1].t

    @property
    def join_time(self) -> Second | None:
        """When the first pursuer joined [s]; `None` if it did not."""
        match self.documents[-1]:
            case FlightEnded(results=(result, *_)) if result.joined:
                return result.join_time
        return None

    def picture(self, t: Second | None = None, **view: Any) -> Picture:
        """What the navigation display shows at one instant; left out, half-way to the join.

        Args:
            t: flight time [s].
            view: as `relguide.picture` takes it.
        """
        half = 0.5 * (self.join_time or self.duration)
        return picture(self.documents, half // 1.0 if t is None else t, **view)

    def widget(self, **view: Any) -> "NavigationDisplay":
        """The display with a slider for the time, for notebooks.

        Args:
            view: what is shown at first: `t` [s], `mode`, `range_nm`, `palette`.

        Raises:
            MissingExtra: if anywidget is not installed.
        """
        need("anywidget")
        from relguide.pictures.widget import NavigationDisplay

        return NavigationDisplay(self.documents, **view)

    def _repr_svg_(self) -> str | None:
        """For notebooks; nothing where QuickJS or the page is not installed."""
        try:
            return str(self.picture(palette="light"))
        except (MissingExtra, ValueError):
            return None

    def __repr__(self) -> str:
        """One line: which flight, how long, and whether it joined."""
        title = next((d.title for d in self.documents if isinstance(d, FlightStarted)), "a flight")
        joined = self.join_time
        how = "did not join" if joined is None else f"joined at {joined:.0f} s"
        return f"Flight({title}: {len(self.documents)} documents, {self.duration:.0f} s, {how})"
