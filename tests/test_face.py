"""The public face is what it says it is."""

import subprocess
import sys
from textwrap import dedent

import pytest

import relguide


def test_all_is_sorted_and_complete() -> None:
    public = {name for name in dir(relguide) if not name.startswith("_")}
    modules = {name for name in public if isinstance(getattr(relguide, name), type(sys))}
    assert set(relguide.__all__) == public - modules
    # constants, then classes, then functions, as ruff sorts them
    assert relguide.__all__ == sorted(relguide.__all__, key=_kind)


def test_dir_shows_public_names_alone() -> None:
    """Whatever has been imported meanwhile."""
    assert relguide.units
    assert {name for name in dir(relguide) if not name.startswith("__")} == {*relguide.__all__}


def test_import_is_light() -> None:
    heavy = (
        "torch", "pydantic", "orjson", "fastapi", "viser", "uvicorn", "relguide_server",
        "relguide.flying", "relguide.maps", "relguide.contract", "relguide.pictures", "quickjs",
    )  # fmt: skip
    code = f"import relguide, sys; sys.exit(' '.join(m for m in {heavy} if m in sys.modules) or 0)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"import relguide loads {done.stderr.strip()}"


def test_what_is_used_beside_plan_is_loaded_when_asked_for() -> None:
    """In a process of its own: here another test has asked for it already."""
    code = """
        import sys
        import relguide

        later = {
            "planning.alternatives": ("Alternative", "alternatives"),
            "planning.batch": ("Situations", "TimeRow", "Times", "plan_arrays"),
            "planning.optimality": ("OptimalityReport", "check"),
            "planning.prove": ("prove",),
            "flying.air": ("Air",),
            "flying.airframe": ("Airframe",),
            "flying.airframe_files": ("airframe", "load_airframe"),
            "flying.flight": ("DeclaredLeader", "Scenario", "fly"),
            "flying.followers": ("Follower",),
            "flying.pilot_model": ("PilotModel",),
            "flying.queues": ("queue_up", "soonest_first"),
            "flying.guidance.settings": ("Settings", "load_settings"),
            "flying.orders": (
                "IntentKnown", "LeaderData", "LeaderHeading", "LeaderSpeed", "PursuerHeading",
                "SetEngagement",
                "PursuerBank",
                "PursuerSpeed",
                "SetAutopilot",
                "SetDirector",
                "SetSpacing",
                "Stick",
            ),
            "flying.simulation": ("simulate",),
            "flying.world": ("Aircraft", "Declared", "Guided", "Link", "Recorded", "World"),
            "flying.scenarios": ("own_scenario", "scenario", "scenario_behind"),
            "flying.recordings.files": ("load_track",),
            "flying.tracks": ("RecordedTrack",),
            "flying.documents": ("FlightEnded", "PlanChanged", "PlanRefused", "Sample"),
            "contract.recorder": ("record", "replay"),
            "pictures.flight": ("Flight",),
            "pictures.picture": ("Picture", "picture"),
            "maps.isochrones": ("Grid", "Isochrones", "isochrones"),
        }
        assert set(relguide.__all__) <= set(dir(relguide)), "dir() leaves a name out"
        for module in later:
            assert f"relguide.{module}" not in sys.modules, f"{module} is loaded"
        for module, names in later.items():
            for name in names:
                found = getattr(relguide, name)
                assert found.__name__ == name, f"{name} is {found}"
                assert found.__module__ == f"relguide.{module}", f"{name} is not its"
                assert name in vars(relguide), f"{name} is looked up each time"
        assert all(hasattr(relguide, name) for name in relguide.__all__)
    """
    done = subprocess.run(
        [sys.executable, "-c", dedent(code)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_a_name_that_is_none_is_refused() -> None:
    with pytest.raises(AttributeError, match=r"^module 'relguide' has no attribute 'planner'$"):
        _ = relguide.planner  # type: ignore[attr-defined]
    assert not hasattr(relguide, "__path_to_nowhere__")


def _kind(name: str) -> tuple[int, str]:
    return (0 if name.isupper() else 1 if name[0].isupper() else 2), name
