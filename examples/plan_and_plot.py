"""Plan a situation given in knots and nautical miles, and draw both tracks over the ground.

Needs `pip install 'relguide[figures]'`; writes plan.svg.
"""

import matplotlib.pyplot as plt

import relguide as rg
from relguide.units import NM

situation = rg.Situation.from_display(
    pursuer=rg.Pursuer.from_display(x_nm=-22, y_nm=22, heading_deg=90, tas_kt=467, max_bank_deg=25),
    leader=rg.Leader.from_display(heading_deg=90, tas_kt=389),
    slot_distance_nm=6,
    min_separation_nm=5,
    wind_from_deg=300,
    wind_kt=40,
)
plan = rg.plan(situation)
if isinstance(plan, rg.NoPlan):
    raise SystemExit(plan.message)
print(plan)

own = plan.over_ground()
leader = situation.leader.trajectory.over_ground(situation.wind, own.t)
figure, axes = plt.subplots()
axes.set(aspect="equal", xlabel="east [NM]", ylabel="north [NM]")
axes.plot(own.x / NM, own.y / NM, label=f"pursuer, {plan.word}")
axes.plot(leader.x / NM, leader.y / NM, label="leader")
axes.legend()
figure.savefig("plan.svg")
