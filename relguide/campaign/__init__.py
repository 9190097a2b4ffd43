"""Campaigns: thousands of flights drawn at random, and what became of them.

    table = campaign("run.toml", "runs/gusts")

`campaign_file.py` says what is asked, `families.py` draws a flight, `keys.py` changes one quantity
of it, `draw.py` does both, `judge.py` flies it and makes a row of figures, `parts.py` keeps rows,
`run.py` has it all done by many, `report.py` says what became of them.
"""

from relguide.campaign.run import campaign as campaign
