"""How the time to converge depends on D and on V_L/V_P: 25 × 31 situations to a table.

Needs nothing but relguide; writes study.csv.
"""

from math import radians

import numpy as np

import relguide as rg

distances, ratios = np.meshgrid(np.linspace(10e3, 22e3, 25), np.linspace(0.65, 0.95, 31))
situations = rg.Situations(
    pursuer_x=-40e3,
    pursuer_y=40e3,
    pursuer_heading=radians(90.0),
    pursuer_tas=240.0,
    max_bank=radians(25.0),
    leader_heading=radians(90.0),
    leader_tas=240.0 * ratios.ravel(),
    slot_distance=distances.ravel(),
    min_separation=9_260.0,
)
times = rg.plan_arrays(situations)
print(times)
table = np.column_stack((distances.ravel(), ratios.ravel(), times.time_to_converge))
header = "slot_distance_m,speed_ratio,time_to_converge_s"
np.savetxt("study.csv", table, "%.3f", ",", header=header, comments="")
