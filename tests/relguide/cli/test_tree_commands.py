"""`relguide dataset` and `relguide area`: what they write, what they say, how they are stopped."""

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from relguide.cli import tree_growth
from relguide.figures.area_figure import Column, column_of, draw_areas
from relguide.learn.tree import reverse_dp
from relguide.learn.tree.reverse_dp import Growth, grow_order, plant
from relguide.learn.tree.tree_file import load_growth, load_tree, save_growth
from relguide.maps.area import Area, Floats
from tests.command_line import Run
from tests.relguide.learn.tree.test_reverse_dp import same
from tests.relguide.learn.tree.trees import parameters, tree

SMALL = (
    "--order", "3", "--delta-theta-deg", "30", "--delta-l-m", "4000", "--cell-m", "6000",
    "--horizon-min", str(400.0 / 60.0),
)  # fmt: skip
DATASET = ("dataset", "--method", "reverse-dp", "--out", "tree.npz")


def test_dataset_writes_the_tree_and_says_what_it_is(run: Run) -> None:
    code, out, err = run(*DATASET, *SMALL, "--audit", "200", "--json")
    assert (code, err) == (0, "")
    told = json.loads(out)
    read = load_tree(Path("tree.npz"))
    assert same(read, tree())
    assert told["states"] == len(tree().minima)
    assert told["trajectories"] == tree().laid
    assert told["file_bytes"] == Path("tree.npz").stat().st_size
    assert told["audit"]["states"] == 200
    shares = [told["audit"][f"share_within_{w}_percent"] for w in ("0", "0.1", "1", "5")]
    assert 0.1 < shares[0] <= shares[1] <= shares[2] <= shares[3] <= 1.0
    assert told["audit"]["missed_by_exact"] == 0
    assert read.provenance["program"].startswith("relguide ")
    assert read.provenance["made"].endswith("+00:00")
    assert [path.name for path in Path().iterdir()] == ["tree.npz"]


def test_dataset_tells_people_in_sentences(run: Run) -> None:
    code, out, _ = run(*DATASET, *SMALL, "--audit", "50", "--threads", "1", "--table")
    assert code == 0
    assert f"the best paths from {len(tree().minima):,} cells" in out
    assert "They are paths, not the fastest ones: of 50 of them" in out
    code, out, _ = run(*DATASET, *SMALL, "--audit", "0", "--table")
    assert (code, "not the fastest ones" in out) == (0, False)


def test_a_stopped_run_is_resumed_to_the_same_tree(run: Run) -> None:
    *_, growth = grow_order(plant(parameters()))
    part = Path("tree.npz.part")
    assert run(*DATASET, *SMALL, "--resume")[1:] == (
        "", "relguide: There is nothing to resume: tree.npz.part does not exist.\n",
    )  # fmt: skip
    save_growth(growth, part)
    code, _, err = run(*DATASET, *SMALL)
    assert code == 2
    assert "is left from a run that was stopped: --resume goes on with it" in err
    code, _, err = run(*DATASET, *SMALL, "--order", "4", "--resume")
    assert code == 2
    assert "was begun with order 3, not 4" in err
    assert run(*DATASET, *SMALL, "--resume", "--audit", "0")[0] == 0
    assert same(load_tree(Path("tree.npz")), tree())
    assert not part.exists()


def test_ctrl_c_leaves_what_resume_goes_on_with(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(start: Growth, *, threads: int | None = None) -> Iterator[Growth]:
        for growth in grow_order(start, threads=threads):
            yield growth
            if growth.order == 2 and growth.next > 9:
                raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(reverse_dp, "BLOCK", 3)
        patched.setattr(tree_growth, "SAVE_EVERY", 0.0)
        patched.setattr(tree_growth, "grow_order", stopped)
        code, out, err = run(*DATASET, *SMALL)
    assert (code, out, err) == (130, "", "\nrelguide: stopped.\n")
    assert [path.name for path in Path().iterdir()] == ["tree.npz.part"]
    assert load_growth(Path("tree.npz.part")).next == 12
    assert run(*DATASET, *SMALL, "--resume", "--audit", "0")[0] == 0
    assert same(load_tree(Path("tree.npz")), tree())


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((*DATASET, "--delta-theta-deg", "7"), "must go into 360°"),
        ((*DATASET, "--delta-l-m", "nan"), "delta_l must be a length above 0 m"),
        ((*DATASET, "--cell-m", "1"), "at most 8 GB"),
        ((*DATASET, "--order", "9"), "order must be 2 … 6"),
        ((*DATASET, "--pursuer-tas-mps", "1000"), "pursuer.tas must lie in"),
        ((*DATASET, "--threads", "x"), "whole number"),
        (("dataset", "--method", "reverse-dp", "--out", "no/tree.npz"), "No such file"),
        (("dataset", "--method", "reverse-dp", "--out", "tree.txt"), "must end in .npz"),
        (("area", "--figure", "area.txt"), "must end in .svg, .png, .pdf, not area.txt"),
        (("area", "--figure", "no/area.svg"), "No such file"),
        (("area", "--figure", "area.svg", "--tree", "none.npz"), "none.npz: No such file"),
        (("area", "--figure", "area.svg", "--headings-deg", "45"), "45° is not one of them"),
    ],
)
def test_misuse_gives_a_sentence(run: Run, arguments: tuple[str, ...], sentence: str) -> None:
    code, out, err = run(*arguments)
    assert (code, out) == (2, "")
    assert sentence in err.splitlines()[-1]
    assert not list(Path().iterdir())


def test_without_matplotlib_it_says_what_brings_it(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    code, _, err = run("area", "--figure", "area.svg")
    assert code == 2
    assert "pip install 'relguide[figures]'" in err


@pytest.mark.parametrize("command", ["dataset", "area"])
def test_help_has_examples(run: Run, command: str) -> None:
    code, out, _ = run(command, "--help")
    assert code == 0
    assert f"examples:\n  relguide {command}" in out


@pytest.mark.slow
def test_planning_loads_neither_torch_nor_matplotlib() -> None:
    program = (
        "import sys, relguide, relguide.__main__ as m\n"
        "from relguide.cli import tree_growth\n"
        "try: m.main(['dataset', '--help'])\n"
        "except SystemExit: pass\n"
        "print('HEAVY', *sorted({'torch', 'matplotlib', 'scipy.spatial'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout.splitlines()[-1] == "HEAVY"


@pytest.mark.slow
def test_area_draws_the_tree_beside_the_exact_area(run: Run) -> None:
    assert run(*DATASET, *SMALL, "--audit", "0")[0] == 0
    area = ("area", "--figure", "area.svg", "--tree", "tree.npz", "--headings-deg", "0", "-60")
    code, out, err = run(*area)
    assert (code, err) == (0, "")
    assert json.loads(out) == {"file": "area.svg", "headings_deg": [0.0, -60.0]}
    code, out, err = run(*area, "--table")
    assert (code, err) == (0, "")
    assert out == "area.svg: the convergence area on 2 headings.\n"
    drawn = Path("area.svg").read_text("utf-8")
    for words in ("Convergence area", "60° to the right", "time to converge [min]", "exact"):
        assert words in drawn


def test_what_the_tree_loses_is_never_less_than_nothing() -> None:
    grown = tree()

    def exact_from(x: Floats, y: Floats, heading: Floats, title: str) -> Floats:
        return tree_growth.plan_places(grown.parameters, x, y, heading, title=title)

    column = column_of(grown, 2, exact_from)
    filled = np.isfinite(column.tree.time)
    assert np.array_equal(filled, np.isfinite(column.loss.time))
    assert column.loss.time[filled].min() >= -1e-6
    assert np.isfinite(column.exact.time).sum() >= filled.sum() * 0.8


@pytest.mark.slow
def test_the_same_data_give_the_same_file(tmp_path: Path) -> None:
    area = Area(
        heading=0.0,
        x=np.linspace(0.0, 4e4, 5),
        y=np.linspace(0.0, 3e4, 4),
        time=60.0 * np.arange(12.0).reshape(4, 3),
    )
    column = Column(tree=area, exact=area, loss=area)
    for name in ("one.svg", "two.svg"):
        draw_areas([column], tree(), tmp_path / name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()
