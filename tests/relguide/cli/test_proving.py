"""The first proof says that it compiles, and compiles what is missing; later ones say nothing."""

import pytest

from relguide import warm_up
from relguide.cli.proving import FIRST, NEEDED, compile_proofs


def test_the_first_proof_says_that_it_compiles(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    compiled: list[tuple[str, ...]] = []
    monkeypatch.setattr(warm_up, "missing", lambda wanted: tuple(wanted)[len(compiled) :])
    monkeypatch.setattr(warm_up, "warm_up", lambda left, jobs: compiled.extend(left))
    compile_proofs()
    assert (tuple(compiled), capsys.readouterr().err) == (NEEDED, FIRST)
    compile_proofs()
    assert (tuple(compiled), capsys.readouterr().err) == (NEEDED, "")
