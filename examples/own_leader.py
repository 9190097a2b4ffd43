"""Join a leader that flies as one's own recording says: positions in a CSV file, as of ADS-B.

Needs `pip install 'relguide[serve]'`; writes leader.csv. It flies east at 400 kt, and after five
minutes turns by 45°, which the pursuer learns only as it happens.
"""

from math import cos, radians, sin
from pathlib import Path

import relguide as rg

lat, lon, rows = 48.0, 2.0, ["timestamp,callsign,latitude,longitude,altitude,groundspeed,track"]
for second in range(1800):
    track = 90.0 + min(max(0.75 * (second - 300), 0.0), 45.0)
    rows.append(f"{1_700_000_000 + second},OWN1,{lat:.6f},{lon:.6f},31000,400,{track:.2f}")
    miles = 400.0 / 3600.0
    lat += miles * cos(radians(track)) / 60.0
    lon += miles * sin(radians(track)) / 60.0 / cos(radians(lat))
Path("leader.csv").write_text("\n".join(rows) + "\n")

scenario = rg.scenario_behind(rg.load_track("leader.csv"))
for document in rg.fly(scenario, rg.plan, sample_period=1.0):
    if isinstance(document, rg.PlanChanged | rg.ModeChanged | rg.LeaderChanged):
        print(f"{document.t:4.0f} s: {document.message}")
    if isinstance(document, rg.FlightEnded):
        result = document.results[0]
        print(f"joined: {result.joined}, never closer than {result.least_separation:,.0f} m")
