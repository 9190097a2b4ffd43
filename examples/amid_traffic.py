"""What a thunderstorm costs a join: plans amid crossing traffic and cells of 15 to 40 km.

Needs nothing but relguide; writes storms.csv. A plan keeps clear of all until two minutes after it
has joined, with a proof for each of them.
"""

from dataclasses import replace
from pathlib import Path

import relguide as rg

free = rg.scenario("fig_6b").situation
joins = rg.plan(free)
assert isinstance(joins, rg.Plan)
crossing = rg.Traffic(
    ident="BAW12", x=0.0, y=-60e3, heading=0.8, tas=220.0, min_separation=free.min_separation
)
middle = joins.over_ground([0.6 * joins.time_to_converge])
x, y = float(middle.x[0]), float(middle.y[0])
rows = ["radius_m,time_to_converge_s,least_from_traffic_m,least_from_cell_m"]
for radius in range(15_000, 40_001, 500):
    cell = rg.Cell(ident="CB1", shape=rg.Disc(x=x, y=y, radius=float(radius)), growth=1.0)
    found = rg.plan(replace(free, others=(crossing, cell)))
    if isinstance(found, rg.Plan):
        near = {other.ident: other.least_separation for other in found.certificate.others}
        rows.append(f"{radius},{found.time_to_converge:.3f},{near['BAW12']:.1f},{near['CB1']:.1f}")
        print(
            f"{radius / 1000:.1f} km: {found.time_to_converge - joins.time_to_converge:.0f} s more"
        )
Path("storms.csv").write_text("\n".join(rows) + "\n")
