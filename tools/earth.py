"""Make the scene's coast lines and airports: `python -m tools.earth LAND.json AIRPORTS.csv`.

LAND.json is `land-10m.json` of the npm package world-atlas (2.0.2: Natural Earth's land at 1:10
million as TopoJSON), AIRPORTS.csv is `airports.csv` of the package airportsdata (20260905):

    npm pack world-atlas@2.0.2                     pip download --no-deps airportsdata==20260905
"""

import csv
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from relguide_server.scene.ground import EARTH, STEP

Line = NDArray[np.float64]

ROUGH = 0.006
"""Coast lines are drawn with corners so far off at most [°]: 670 m."""
CUT = 5.0
"""No coast runs straight for so long [°]."""
ISLET = 0.03
"""Land whose outline is smaller than this both ways is left out [°]: 3 km."""


def main(land: Path, airports: Path) -> None:
    """Write both into one compressed file of arrays."""
    arcs = coast_lines(json.loads(land.read_text()))
    lines = [simplified(line) for arc in arcs for line in without_cuts(arc)]
    lines = [line for line in lines if len(line) > 1 and np.ptp(line, axis=0).max() > ISLET]
    whole = [np.rint(line / STEP).astype(np.int32) for line in lines]
    codes, sites = known_airports(airports)
    np.savez_compressed(
        EARTH,
        # Differences are small and repeat, which is what compresses.
        steps=np.concatenate([np.diff(line, axis=0) for line in whole]).astype(np.int16),
        starts=np.array([line[0] for line in whole]),
        lengths=np.array([len(line) - 1 for line in whole], dtype=np.int32),
        codes=np.array(codes, dtype="S4"),
        sites=np.rint(sites / STEP).astype(np.int32),
    )
    sys.stdout.write(
        f"{len(lines)} coast lines of {sum(map(len, lines))} points, {len(codes)} airports: "
        f"{EARTH.stat().st_size / 1000:.0f} kB in {EARTH}\n"
    )


def coast_lines(topology: dict[str, Any]) -> list[Line]:
    """The arcs of a TopoJSON topology as longitudes and latitudes [°], (n, 2) each."""
    transform = topology["transform"]
    scale, first = np.array(transform["scale"]), np.array(transform["translate"])
    return [np.cumsum(np.array(arc), axis=0) * scale + first for arc in topology["arcs"]]


def without_cuts(arc: Line) -> list[Line]:
    """Its parts that are coast: land is also cut at the antimeridian, and at the south pole."""
    along = np.abs(np.diff(arc, axis=0)).max(axis=1)
    at_edge = np.abs(arc[:, 0]) > 179.99
    is_cut = (along > CUT) | (at_edge[:-1] & at_edge[1:]) | (arc[:-1, 1] < -89.0)
    return np.split(arc, np.flatnonzero(is_cut) + 1)


def simplified(line: Line) -> Line:
    """A line without the points that lie within `ROUGH` of it (Douglas & Peucker 1973)."""
    kept = np.zeros(len(line), dtype=bool)
    kept[[0, -1]] = True
    left = [(0, len(line) - 1)]
    while left:
        a, b = left.pop()
        if b - a < 2:
            continue
        along, off = line[b] - line[a], line[a + 1 : b] - line[a]
        length = np.hypot(*along)
        if length > 0.0:
            apart = np.abs(off[:, 0] * along[1] - off[:, 1] * along[0]) / length
        else:
            apart = np.hypot(off[:, 0], off[:, 1])
        k = int(np.argmax(apart))
        if apart[k] > ROUGH:
            kept[a + 1 + k] = True
            left += [(a, a + 1 + k), (a + 1 + k, b)]
    return line[kept]


def known_airports(file: Path) -> tuple[list[str], Line]:
    """Codes by ICAO, and longitudes and latitudes [°], of the airports that airlines serve."""
    with file.open(encoding="utf-8") as rows:
        found = [row for row in csv.DictReader(rows) if row["iata"] and len(row["icao"]) == 4]
    return (
        [row["icao"] for row in found],
        np.array([(float(row["lon"]), float(row["lat"])) for row in found]),
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
