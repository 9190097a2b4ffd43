"""`relguide dataset --method exact`, `train` and `audit`: the chain from labels to figures."""

import json
from itertools import islice
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from relguide.learn.words.branch_labels import LabelRequest, label_chunk, load_labels, save_labels
from relguide.learn.words.branch_network import load_network
from relguide.learn.words.train_branches import run as training
from tests.command_line import Run
from tests.relguide.learn.words.networks import options

EXACT = ("dataset", "--method", "exact", "--out", "labels.npz", "--count", "3000")


def test_labels_train_weights_and_audit(run: Run) -> None:
    code, out, err = run(*EXACT, "--json")
    assert (code, err) == (0, "")
    told = json.loads(out)
    read, about = load_labels(Path("labels.npz"))
    assert told["labels"] == len(read) == sum(told["fastest"].values()) == 3000
    assert np.array_equal(read.times, label_chunk(LabelRequest(count=3000, seed=7), 0).times)
    assert about["provenance"]["command"] == (
        "relguide dataset --method exact --count 3000 --seed 7 --out labels.npz"
    )
    size = ("--width", "16", "--depth", "1", "--epochs", "3", "--batch", "128", "--threads", "1")
    code, out, err = run("train", "labels.npz", "w.safetensors", *size, "--table")
    assert (code, err) == (0, "")
    assert "w.safetensors: the best of 3 epochs is the " in out
    assert load_network(Path("w.safetensors")).about["program"].startswith("relguide ")
    code, out, err = run("audit", "w.safetensors", "--count", "1000", "--beside", "0", "--json")
    assert (code, err) == (0, "")
    told = json.loads(out)
    assert told["groups"]["random"]["situations"] > 600
    assert told["network"]["options"]["shape"] == {"width": 16, "depth": 1}
    assert 0.0 < told["latency"]["network"]["p50_us"] <= told["latency"]["network"]["p99_us"]
    assert "side_by_side" not in told
    assert sorted(path.name for path in Path().iterdir()) == ["labels.npz", "w.safetensors"]


def test_what_was_stopped_at_its_end_is_only_said_to_be_complete(run: Run) -> None:
    run(*EXACT)
    arguments = ("labels.npz", "w.safetensors", "--width", "8", "--epochs", "2", "--threads", "1")
    list(islice(training(options(*arguments), "a test"), 2))  # all its epochs, but not its end
    written, part = Path("w.safetensors").read_bytes(), Path("w.safetensors.part")
    assert part.exists()
    assert run("train", *arguments, "--resume", "--table") == (
        0, "w.safetensors is complete.\n", "",
    )  # fmt: skip
    assert (Path("w.safetensors").read_bytes(), part.exists()) == (written, False)


def test_people_get_sentences_and_a_table(run: Run) -> None:
    code, out, _ = run(*EXACT, "--threads", "1", "--table")
    assert (code, "Fastest: LSL " in out) == (0, True)
    code, out, err = run("audit", "--count", "1000", "--beside", "0", "--table")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert max(map(len, lines)) <= 100
    assert "…" not in lines[1]
    names = [line.split("  ")[0].strip() for line in lines]
    for name in (
        "random",
        "at switching surfaces",
        "in closed loops",
        "unseen range 6 … 7 R",
        "RLR long",
    ):
        assert name in names
    assert names.index("CPU time of one query, µs") < names.index("network")
    assert "Slower than the fastest by more than 0.01 %: " in out


@pytest.mark.slow
def test_four_are_audited_side_by_side_and_drawn(run: Run) -> None:
    asked = ("audit", "--count", "1000", "--beside", "200", "--figures", "docs/figures")
    code, out, err = run(*asked, "--table")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert max(map(len, lines)) <= 100
    assert "…" not in out.partition("Side by side: 200 situations within 10 min")[2]
    header = next(line for line in lines if "nearest in tree" in line)
    names = ("ours", "nearest in tree", "paper's network", "direct regression")
    assert [header.index(name) for name in names] == sorted(header.index(name) for name in names)
    drawn = sorted(Path("docs/figures").iterdir())
    assert [file.name for file in drawn] == [
        "network_accuracy.svg", "network_calibration.svg", "network_gaps.svg",
    ]  # fmt: skip
    for file in drawn:
        picture = file.read_text("utf-8")
        assert "[%]" in picture
        assert ElementTree.fromstring(picture).tag.endswith("svg")
    code, out, err = run(*asked[:5], "--json")
    assert (code, err) == (0, "")
    beside = json.loads(out)["side_by_side"]
    assert beside["situations"] == 200
    assert list(beside["methods"]) == list(names)


def test_misuse_is_said_in_a_sentence(run: Run) -> None:
    assert run(*EXACT, "--resume")[::2] == (
        2, "relguide: Labels are made in a minute or two, and nothing is left to resume.\n",
    )  # fmt: skip
    assert run("dataset", "--method", "exact", "--out", "none/labels.npz")[0] == 2
    assert run("audit", "none.safetensors")[2] == (
        "relguide: none.safetensors: No such file or directory.\n"
    )
    seed = load_network().about["dataset"]["seed"]
    assert f"seen the situations of seed {seed}" in run("audit", "--seed", f"{seed}")[2]
    assert "labels.npz: No such file" in run("train", "labels.npz", "w.safetensors")[2]
    Path("labels.npz").write_bytes(b"PK")
    assert "holds no labels" in run("train", "labels.npz", "w.safetensors")[2]
    save_labels(
        label_chunk(LabelRequest(count=100), 0), LabelRequest(count=100), {}, Path("labels.npz")
    )
    code, _, err = run("train", "labels.npz", "w.safetensors", "--epochs", "0")
    assert (code, err) == (2, "relguide: epochs must be 1 or more, not 0.\n")
