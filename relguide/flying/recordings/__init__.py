"""Recorded flights, from what people have to a `RecordedTrack`.

`reports.py` says what a recording holds, in our units. A reader for each form makes one:
`columns.py` (tables as text), `records.py` (JSON of the package traffic), `readsb.py`, `fr24.py`,
`scn.py` (scenarios of BlueSky, which it flies). `files.py` finds the reader of a file, `samples.py`
the collections of traffic. `flights.py` parts the reports into flights, `stretch.py` takes the part
of one that can be flown behind, and `together.py` puts two into one plane and on one clock.
`exchanged.py` refuses latitudes in the place of longitudes.
"""
