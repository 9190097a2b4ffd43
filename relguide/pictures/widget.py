"""The navigation display in a notebook: the element `<relguide-nd>` with a slider for the time.

What is set from Python shows there, and what is moved there is read from Python.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import anywidget
import traitlets

from relguide.contract.recorder import read_lines, written
from relguide.flying.documents import Document
from relguide.pictures.bundles import bundle

RENDER = """
export default {
  render({ model, el }) {
    const nd = document.createElement("relguide-nd");
    const time = document.createElement("input");
    Object.assign(time, { type: "range", step: 1, ariaLabel: "Flight time" });
    nd.style.maxWidth = time.style.width = "640px";
    const show = () => {
      nd.setAttribute("palette", model.get("palette"));
      nd.mode = model.get("mode");
      nd.range = model.get("range_nm") ?? "auto";
      nd.t = model.get("t");
      time.value = nd.t;
    };
    nd.documents = model.get("text");
    [time.min, time.max] = [nd.documents[0].t_s, nd.documents.at(-1).t_s];
    show();
    time.addEventListener("input", () => {
      model.set("t", Number(time.value));
      model.save_changes();
    });
    nd.addEventListener("select", ({ detail }) => {
      model.set("selected", detail.ident);
      model.save_changes();
    });
    for (const name of ["t", "mode", "range_nm", "palette"]) model.on(`change:${name}`, show);
    el.append(nd, time);
  },
};
"""


class NavigationDisplay(anywidget.AnyWidget):
    """A flight in a notebook: `NavigationDisplay(documents)`, or of a recording's name."""

    _esm = bundle("relguide-nd.js").read_text() + RENDER
    text = traitlets.Unicode().tag(sync=True)
    t = traitlets.Float(0.0).tag(sync=True)
    mode = traitlets.Enum(("ARC", "ROSE"), "ARC").tag(sync=True)
    range_nm = traitlets.Enum((10, 20, 40, 80, 160, 320), None, allow_none=True).tag(sync=True)
    palette = traitlets.Enum(("dark", "light"), "dark").tag(sync=True)
    selected = traitlets.Unicode("").tag(sync=True)

    def __init__(self, flight: Iterable[Document] | Path | str, **view: Any) -> None:
        """Hold all of a flight.

        Args:
            flight: its documents, or the name of a recording.
            view: what is shown of it: `t` [s], `mode`, `range_nm`, `palette`.
        """
        lines = read_lines(flight) if isinstance(flight, str | Path) else written(flight, 1.0)
        super().__init__(text=b"".join(line for _, line in lines).decode(), **view)
