"""What the benchmarks rest on: a page with its pictures, an honest peer, a run that goes on."""

from math import inf
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

from relguide.kernels.extremals import MAX_ROWS, solve
from tests.bench.exhaustive import least_time
from tests.bench.limit import compared, main
from tests.bench.page import BEGIN, COMMAND, END, FOLDER, PAGE, PICTURES, with_block
from tests.situations import headings, numbers

ROOT = Path(__file__).parents[1]


def test_the_page_shows_the_pictures_and_says_how_they_are_made() -> None:
    page = PAGE.read_text()
    assert COMMAND in page
    assert f"\n{COMMAND.removeprefix('make ')}:" in (ROOT / "Makefile").read_text()
    for name in PICTURES:
        picture = FOLDER / name
        assert f"]({FOLDER.name}/{name})" in page
        assert "</svg>" in picture.read_text()
    # what is measured again takes the place of what was measured before
    again = with_block(with_block(page, "old"), "| new |")
    assert "| new |" in again
    assert "old" not in again[again.index(BEGIN) : again.index(END)]


@pytest.mark.parametrize("page", ["no markers", f"{END} {BEGIN}", f"{BEGIN}{END}{BEGIN}{END}"])
def test_a_page_without_its_markers_is_left_alone(page: str) -> None:
    with pytest.raises(ValueError, match="once each"):
        with_block(page, "tables")


@pytest.mark.slow
@given(x=numbers(-20.0, 20.0), y=numbers(-20.0, 20.0), h=headings, alpha=numbers(0.3, 0.98))
def test_no_scan_of_every_word_beats_the_kernel(x: float, y: float, h: float, alpha: float) -> None:
    rows = np.empty((MAX_ROWS, 5))
    assert solve(x, y, h, alpha, 0.0, rows) > 0
    plain = least_time(x, y, h, alpha)
    assert plain < inf
    assert rows[0, 0] <= plain + 1e-6


@pytest.mark.slow
def test_a_comparison_goes_on_where_it_stopped(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "finished.jsonl"
    options = ["--effort", "2", "--processes", "1", "--intent", "0.5", "--resume", str(file)]
    assert main(["--count", "2", *options]) == 0
    begun = file.read_text()
    with file.open("a") as cut_short:
        cut_short.write('{"case": 2, "tight"')
    assert main(["--count", "4", *options]) == 0
    assert file.read_text().startswith(begun)
    assert len(file.read_text().splitlines()) == 1 + 4
    assert "4 active situations" in capsys.readouterr().out
    assert main(["--count", "4", *options, "--effort", "3"]) == 2
    assert "effort 2" in capsys.readouterr().err


def test_a_case_is_what_its_number_says() -> None:
    first, again = (compared(5, seed=1, effort=1, intent=0.5) for _ in range(2))
    assert (first.situation, first.ours_s) == (again.situation, again.ours_s)
    assert first.loss == 0.0
