"""What was obtained last holds, and docs/claims.md is made of it."""

from pathlib import Path
from shutil import copytree

import pytest

from relguide.claims import kept
from relguide.claims.claim import all_claims
from relguide.claims.kept import clone, keep_obtained, read_obtained
from relguide.claims.page import claims_page
from relguide.claims.run import check_claims
from tests.pages import ROOT


def test_kept_tables_say_what_is_claimed() -> None:
    *_, last = check_claims([claim for claim in all_claims() if claim.runs == "kept"], ROOT)
    assert [(one.claim.name, one.obtained, one.why) for one in last.checked if not one.ok] == []


def test_what_was_obtained_is_what_is_claimed() -> None:
    obtained = read_obtained(all_claims(), ROOT)
    known = {claim.name: claim for claim in all_claims()}
    assert set(obtained) <= set(known)
    assert {claim.name for claim in all_claims() if claim.runs == "quick"} <= set(obtained)
    assert [name for name, value in obtained.items() if not known[name].holds(value)] == []


def test_the_page_is_made_of_the_registry_and_what_was_obtained() -> None:
    page = claims_page(all_claims(), read_obtained(all_claims(), ROOT))
    said = "relguide claims --page docs/claims.md writes it anew"
    assert (ROOT / "docs" / "claims.md").read_text("utf-8") == page, said


def test_a_run_of_some_leaves_the_others_as_they_were(tmp_path: Path) -> None:
    copytree(ROOT / "benchmarks" / "results", tmp_path / "benchmarks" / "results")
    before = read_obtained(all_claims(), tmp_path)
    keep_obtained(all_claims(), {}, tmp_path)
    assert read_obtained(all_claims(), tmp_path) == before
    keep_obtained(all_claims(), {"fig-6a-joins": 1017.25}, tmp_path)
    assert read_obtained(all_claims(), tmp_path) == before | {"fig-6a-joins": 1017.25}


def test_a_clone_is_known_by_its_tables(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert clone() == ROOT
    monkeypatch.setattr(kept, "__file__", str(tmp_path / "relguide" / "claims" / "kept.py"))
    assert clone() is None
