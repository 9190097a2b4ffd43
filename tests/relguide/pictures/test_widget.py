"""The widget: what it holds for the notebook."""

import json
from pathlib import Path

import pytest
import traitlets

from relguide import Flight, fly, plan, record, scenario


@pytest.mark.slow
def test_it_holds_a_flight_and_what_is_shown_of_it(tmp_path: Path) -> None:
    from relguide.pictures.widget import NavigationDisplay

    file = tmp_path / "flight.jsonl"
    flight = Flight(record(fly(scenario("fig_6b"), plan, sample_period=1.0), file))
    shown = flight.widget(t=560, mode="ROSE", range_nm=80)
    assert shown.text == NavigationDisplay(file).text
    kinds = [json.loads(line)["kind"] for line in shown.text.splitlines()]
    assert (kinds[0], kinds[-1]) == ("flight_started", "flight_ended")
    assert (shown.t, shown.mode, shown.range_nm, shown.palette) == (560.0, "ROSE", 80, "dark")
    assert 'customElements.define("relguide-nd"' in shown._esm.replace("`", '"')
    assert shown._esm.rstrip().endswith("};")
    with pytest.raises(traitlets.TraitError):
        shown.range_nm = 50
