"""What the benchmarks rest on: a page with its pictures, an honest peer, a run that goes on."""

from math import cos, inf, pi, sin
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

from benchmarks import draws, kept, network
from benchmarks.cases import turning_cases, unlimited_cases
from benchmarks.exhaustive import least_time
from benchmarks.limit import main, plan_twice
from benchmarks.network_batch import as_row
from benchmarks.network_rows import BY_NETWORK, answer_rows
from benchmarks.page import COMMAND, FOLDER, GALLERY, PAGE, PICTURE, RESULTS, with_block
from benchmarks.starts import guesses
from benchmarks.tables import read_table, write_table
from relguide import NoPlan
from relguide.figures.ours.planners import time_in_words
from relguide.figures.results import read_results
from relguide.kernels.base.angles import FULL_TURN_SLACK
from relguide.kernels.base.records import Pose
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.learn.boundary.template_network import load_template_network
from relguide.learn.network_planner import network_planner
from relguide.learn.words.branch_network import load_network
from relguide.planning.constrained_path import BEARINGS
from tests.situations import headings, numbers

ROOT = Path(__file__).parents[1]


BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"


def test_the_page_shows_the_pictures_and_says_how_they_are_made() -> None:
    page = PAGE.read_text()
    assert COMMAND in page
    assert f"\n{COMMAND.removeprefix('make ')}:" in (ROOT / "Makefile").read_text()
    for picture in (FOLDER / PICTURE, GALLERY / "separation.svg", GALLERY / "planners.svg"):
        assert f"]({picture.relative_to(PAGE.parent).as_posix()})" in page
        assert "</svg>" in picture.read_text()
    # what is measured again takes the place of what was measured before
    again = with_block(with_block(page, "measured", "old"), "measured", "| new |")
    assert "| new |" in again
    assert "old" not in again[again.index(BEGIN) : again.index(END)]


def test_page_and_picture_show_the_same_run() -> None:
    page = PAGE.read_text()
    assert with_block(page, "measured", kept.block()) == page
    planners = (GALLERY / "planners.svg").read_text()
    for name, column, unit in (
        ("without_limit.csv", "median µs", 1e-6),
        ("with_limit.csv", "median ms", 1e-3),
    ):
        for row in read_results(name):
            assert f">{time_in_words(unit * float(row[column]))}</text>" in planners, row["name"]
    _, cells = read_table(kept.COST)
    (medians,) = [costs for share, *costs in cells if share == "50"]
    gallery = (PAGE.parent / "gallery.md").read_text()
    assert all(f"{float(median):.0f} s where R" in gallery for median in medians)


def test_tables_are_kept_as_numbers(tmp_path: Path) -> None:
    write_table("some.csv", ("name", "µs", "worst"), [["a, b", "1,024", "+1,773.3"]], tmp_path)
    assert read_table("some.csv", tmp_path) == (
        ["name", "µs", "worst"],
        [["a, b", "1024", "+1773.3"]],
    )


@pytest.mark.parametrize("page", ["no markers", f"{END} {BEGIN}", f"{BEGIN}{END}{BEGIN}{END}"])
def test_a_page_without_its_markers_is_left_alone(page: str) -> None:
    with pytest.raises(ValueError, match="once each"):
        with_block(page, "measured", "tables")


def test_ipopt_is_set_the_leader_s_own_turns_and_begins_with_paths_to_the_slot() -> None:
    for case in turning_cases(4):
        leader, course = case.situation.leader.trajectory, case.course
        x, y, h = course.x, course.y, course.h
        for before, rate, lasts in course.turns:
            x, y = x + case.frame.alpha * before * cos(h), y + case.frame.alpha * before * sin(h)
            radius = case.frame.alpha / rate
            x, y = x - radius * sin(h), y + radius * cos(h)
            h += rate * lasts
            x, y = x + radius * sin(h), y - radius * cos(h)
        # trailing straights belong to the final leg
        ended = leader.pose_at(course.ends * case.unit)
        assert (x, y) == pytest.approx(case.frame.to_slot(ended.x, ended.y), abs=1e-9)
        assert cos(h - case.frame.heading + ended.heading) == pytest.approx(1.0)
        seen = x - case.frame.alpha * course.ends, y
        assert seen == pytest.approx(case.from_slot, abs=1e-9)
        starts = guesses(case, 40)
        assert len(starts) == 5
        for start in starts:
            assert start.time >= case.frame.t_release
            assert start.states[0] == pytest.approx((case.frame.x, case.frame.y, case.frame.h))
            ahead, left, heading = start.states[-1]
            assert (ahead, left, cos(heading)) == pytest.approx((0.0, 0.0, 1.0), abs=1e-6)


@pytest.mark.slow
@given(x=numbers(-20.0, 20.0), y=numbers(-20.0, 20.0), h=headings, alpha=numbers(0.3, 0.98))
def test_no_scan_of_every_word_beats_the_kernel(x: float, y: float, h: float, alpha: float) -> None:
    rows = np.empty((MAX_ROWS, 5))
    assert solve(Pose(x, y, h), alpha, 0.0, rows) > 0
    nearly = min(h, 2.0 * pi - h) < FULL_TURN_SLACK  # a turn this small is rounding of none
    plain = least_time(x, y, 0.0 if nearly else h, alpha)
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


def test_how_much_faster_networks_are_is_said_by_medians_and_by_sums() -> None:
    pairs = [
        network.Pair(by_network=cpu < 5e-3, late=0.0, network_cpu=cpu, plan_cpu=10e-3)
        for cpu in (1e-3, 1e-3, 8e-3)
    ]
    told = network.table({"some": pairs})
    row = {str(column.header): next(iter(column.cells)) for column in told.columns}
    assert len(told.columns) == len(network.HEADINGS)
    assert (row["by network"], row["×"], row["× by sums"]) == ("66.7%", "10.0", "3.0")


@pytest.mark.slow
def test_a_batch_by_networks_gives_what_their_planner_gives() -> None:
    rng = np.random.default_rng(12)
    drawn = [draws.near(rng, tight=bool(k % 2)) for k in range(40)]
    rows, answers = np.array([as_row(situation) for situation in drawn]), np.zeros((40, 4))
    answer_rows(rows, load_template_network(), BEARINGS, 0, 40, answers)
    planner = network_planner(load_network())
    answered = 0
    for situation, (time, _, verdict, _) in zip(drawn, answers.tolist(), strict=True):
        planned = planner(situation)
        if isinstance(planned, NoPlan):
            assert time == inf
            continue
        scale = situation.pursuer.turn_radius / situation.pursuer.tas
        assert time * scale == pytest.approx(planned.time_to_converge, abs=0.02)
        assert (verdict == BY_NETWORK) == (planned.planner == "network")
        answered += verdict == BY_NETWORK
    assert answered > 25


def test_cases_are_golden_and_drawn() -> None:
    golden = len(unlimited_cases(0))
    assert golden > 100
    assert len(unlimited_cases(2)) == golden + 2


def test_a_case_is_what_its_number_says() -> None:
    first, again = (plan_twice(5, seed=1, effort=1, intent=0.5) for _ in range(2))
    assert (first.situation, first.ours_s) == (again.situation, again.ours_s)
    assert first.loss == 0.0


def test_every_table_that_is_kept_says_how_it_was_made() -> None:
    told = (RESULTS / "README.md").read_text()
    for file in RESULTS.glob("*.csv"):
        assert f"`{file.name}`" in told, file.name
        headings, cells = read_table(file.name)
        assert all(len(line) == len(headings) for line in cells), file.name
