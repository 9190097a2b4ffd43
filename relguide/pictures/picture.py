"""picture(documents, t) → SVG: the navigation display at one instant of a flight.

The program that draws it is the cockpit's own (`web/src/picture`), run by QuickJS: at whole seconds
of a recording it gives the same bytes there, in Node and in a browser.
"""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, Literal, get_args

from relguide.contract.recorder import read_lines, written
from relguide.flying.documents import Document, Sample
from relguide.pictures.bundles import bundle
from relguide.planning.extras import need
from relguide.planning.inputs import number
from relguide.units import Second

Mode = Literal["ARC", "ROSE"]
Palette = Literal["dark", "light"]
RANGES_NM = (10, 20, 40, 80, 160, 320)
"""Ranges of the display [NM]."""
CALL = "(text, options) => relguide.pictureOf(text, JSON.parse(options))"


class Picture(str):
    """A drawing as SVG text, which notebooks show.

    Examples:
        >>> flown = rg.fly(rg.scenario("fig_6b"), rg.plan, sample_period=1.0)
        >>> rg.picture(flown, 60.0).png(zoom=1)[1:4]
        b'PNG'
    """

    __slots__ = ()

    def _repr_svg_(self) -> str:
        return str(self)

    def png(self, *, zoom: int = 2) -> bytes:
        """The same in pixels.

        Args:
            zoom: pixels for each unit of the drawing, 1 to 8; the glass has 768 units.

        Raises:
            MissingExtra: if resvg-py is not installed.
            ValueError: if the zoom is out of range.
        """
        need("resvg_py")
        import resvg_py

        if zoom not in range(1, 9):
            raise ValueError(f"zoom must be a whole number from 1 to 8, not {zoom!r}.")
        font = str(bundle("b612.ttf"))
        return bytes(resvg_py.svg_to_bytes(svg_string=str(self), font_files=[font], zoom=zoom))


def picture(
    flight: Iterable[Document] | Path | str,
    t: Second,
    *,
    mode: Mode = "ARC",
    range_nm: int | None = None,
    palette: Palette = "dark",
    caption: str = "",
) -> Picture:
    """What the navigation display shows of a flight at one instant.

    Of the documents those up to `t` are taken, so a flight that is still to be flown is flown no
    further; of their samples one a second, as `record` writes them.

    Examples:
        >>> flown = rg.fly(rg.scenario("fig_6b"), rg.plan, sample_period=1.0)
        >>> rg.picture(flown, 60.0, mode="ROSE", range_nm=40)[:4]
        '<svg'

    Args:
        flight: its documents, or the name of a recording.
        t: flight time [s].
        mode: `ARC` looks ahead, `ROSE` all round.
        range_nm: one of `RANGES_NM`; left out, the smallest with path, leader and slot in sight.
        palette: `dark` as in the cockpit, `light` for paper.
        caption: what stands under the line with title, time and version.

    Raises:
        MissingExtra: if quickjs-ng is not installed.
        RecordingError: naming the first line of a file that is not a document.
        ValueError: if `t` is outside the flight, or the view is none.
    """
    for name, value, known in (("mode", mode, Mode), ("palette", palette, Palette)):
        if value not in get_args(known):
            raise ValueError(f"{name} must be {' or '.join(get_args(known))}, not {value!r}.")
    if range_nm is not None and range_nm not in RANGES_NM:
        ranges = ", ".join(map(str, RANGES_NM))
        raise ValueError(f"range_nm must be one of {ranges} NM, not {range_nm!r}.")
    need("quickjs")
    t = number("t", t)
    lines = read_lines(flight) if isinstance(flight, str | Path) else written(flight, 1.0)
    text = _until(lines, t)
    view = {"t": t, "mode": mode, "range": range_nm or "auto", "palette": palette}
    return Picture(_draw(text.decode(), view | {"caption": caption}))


def _until(lines: Iterator[tuple[Document, bytes]], t: Second) -> bytes:
    """What is written of a flight up to a time, and to the next sample, towards which it moves."""
    kept: list[bytes] = []
    first = last = None
    for document, line in lines:
        first = document.t if first is None else first
        last = document.t
        if t >= first:
            kept.append(line)
            if last > t and line and isinstance(document, Sample):
                break
    if first is None or last is None:
        raise ValueError("There is nothing to draw: the flight has no documents.")
    if not first <= t <= last:
        raise ValueError(
            f"t = {t:g} s is outside the flight, which goes from {first:g} s to {last:g} s."
        )
    return b"".join(kept)


def _draw(text: str, options: dict[str, Any]) -> str:
    import quickjs
    from pydantic_core import to_json

    engine = quickjs.Context()
    engine.eval(bundle("picture.js").read_text())
    try:
        drawn: str = engine.eval(CALL)(text, to_json(options).decode())
    except quickjs.JSException as error:
        raise ValueError(f"The flight cannot be drawn: {str(error).splitlines()[0]}") from None
    return drawn
