"""The constants of guidance: read from TOML with their units, and refused with a sentence."""

from dataclasses import fields, replace
from pathlib import Path

import pytest

from relguide.flying.documents import PlanChanged
from relguide.flying.flight import fly
from relguide.flying.guidance.commit.better import may_be_improved
from relguide.flying.guidance.commit.proposal import Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.settings import DEFAULT, FLAGS, Settings, load_settings
from relguide.flying.plan_documents import TurnSegment
from relguide.flying.scenarios import fig_6
from relguide.planning.plan import plan
from relguide.units import DEG, KT, NM
from tests.relguide.flying.guidance.beliefs import observe


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "guidance.toml"


def test_keys_carry_their_units_and_the_rest_keeps_its_default(file: Path) -> None:
    file.write_text(
        "[guidance]\nbank_in_hand_deg = 3.0\nseparation_buffer_nm = 0.2\ncaution_s = 45\n"
        "leader_speed_kt = 5\nown_off_m = 80\nbetter_share = 0.01\ndamping = 0.7\n"
        "turning_degps = 0.5\nbank_in_hand_share = 0.2\nbetter_s = 2\n"
    )
    assert load_settings(file) == replace(
        DEFAULT,
        bank_in_hand=3.0 * DEG,
        separation_buffer=0.2 * NM,
        caution=45.0,
        leader_speed=5.0 * KT,
        own_off=80.0,
        better_share=0.01,
        turning=0.5 * DEG,
        bank_in_hand_share=0.2,
        better=2.0,
        damping=0.7,
    )
    assert load_settings(str(file)) == load_settings(file)


def test_a_flag_is_true_or_false(file: Path) -> None:
    file.write_text("[guidance]\nalways_ask = true\n")
    assert load_settings(file) == replace(DEFAULT, always_ask=True)


def test_an_empty_table_is_the_default(file: Path) -> None:
    file.write_text("[guidance]\n")
    assert load_settings(file) == DEFAULT


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("[guidance", r"guidance\.toml is not TOML: "),
        ("caution_s = 45", r"guidance\.toml must have one table, \[guidance\]\."),
        ("[guidance]\n[other]", r"guidance\.toml must have one table, \[guidance\]\."),
        ("guidance = 3", r"guidance\.toml must have one table, \[guidance\]\."),
        (
            "[guidance]\ncautious_s = 4",
            r"there is no setting 'cautious_s'; a setting is a field's name and its unit, "
            r"for example bank_in_hand_deg\.",
        ),
        ("[guidance]\ncaution_min = 1", "there is no setting 'caution_min'"),
        ("[guidance]\ncaution = 45", "there is no setting 'caution'"),
        ("[guidance]\ncaution_deg = 45", "there is no setting 'caution_deg'"),
        ("[guidance]\ndamping_s = 1", "there is no setting 'damping_s'"),
        (
            "[guidance]\nown_off_m = 60\nown_off_nm = 0.1",
            r"guidance\.toml: own_off must be given once, in one unit\.",
        ),
        ("[guidance]\ncaution_s = true", "caution_s must be a number, not True"),
        ("[guidance]\ncaution_s = 'a'", "caution_s must be a number, not 'a'"),
        ("[guidance]\ncaution_s = 0", r"toml: caution must be a number above 0, not 0\.0"),
        ("[guidance]\ncaution_s = -3", r"caution must be a number above 0, not -3\.0"),
        ("[guidance]\ncaution_s = inf", "caution must be a number above 0, not inf"),
        ("[guidance]\nalways_ask = 1", r"toml: always_ask must be True or False, not 1 \(int\)"),
        ("[guidance]\nalways_ask_s = 1", "there is no setting 'always_ask_s'"),
        ("[guidance]\ncaution_s = nan", "caution must be a number above 0, not nan"),
    ],
)
def test_what_is_wrong_is_said_with_the_file(file: Path, text: str, sentence: str) -> None:
    file.write_text(text)
    with pytest.raises(ValueError, match=sentence):
        load_settings(file)


def test_what_is_not_text_is_no_toml(file: Path) -> None:
    file.write_bytes(b"\xff\xfe")
    with pytest.raises(ValueError, match="is not TOML"):
        load_settings(file)


@pytest.mark.parametrize("name", [f.name for f in fields(Settings) if f.name not in FLAGS])
def test_every_number_must_be_above_zero(name: str) -> None:
    with pytest.raises(ValueError, match=f"^{name} must be a number above 0, not 0"):
        replace(DEFAULT, **{name: 0.0})  # type: ignore[arg-type]


@pytest.mark.parametrize(("most", "planned"), [(25.0, 22.5), (30.0, 27.5), (15.0, 13.5)])
def test_plans_leave_bank_in_hand(most: float, planned: float) -> None:
    """2.5°, or a tenth where the bank is gentle."""
    assert DEFAULT.planned_bank(most * DEG) == pytest.approx(planned * DEG)


@pytest.mark.parametrize(("seconds", "worth"), [(3.0, False), (8.0, True)])
def test_far_ahead_half_a_percent_of_the_time_left_is_worth_a_change(
    seconds: float, worth: bool
) -> None:
    found = propose(*observe(fig_6(intent_known=True)), None, plan)
    assert isinstance(found, Proposal)
    planned = found.committed.plan
    bound = planned.time_to_converge - seconds
    loose = replace(planned.optimality, lower_bound=bound)
    committed = found.committed._replace(plan=replace(planned, optimality=loose))
    assert committed.due == pytest.approx(917.0, abs=20.0)
    _, assignment = observe(fig_6(intent_known=True))
    assert may_be_improved(committed, 0.0, assignment) == worth


def test_flights_are_flown_with_the_settings_given() -> None:
    """Asked for 25°, of 30° that the autopilot may use: with 8° in hand the plan turns at 22°."""
    wide = replace(DEFAULT, bank_in_hand=8.0 * DEG, bank_in_hand_share=0.5)
    banks = []
    for settings in (DEFAULT, wide):
        plans = (d for d in fly(fig_6(intent_known=False), plan, settings=settings))
        first = next(d for d in plans if isinstance(d, PlanChanged))
        banks += [max(s.bank for s in first.plan.segments if isinstance(s, TurnSegment))]
    assert banks == pytest.approx([25.0 * DEG, 22.0 * DEG])
