"""`dataset`, `train` and `audit --method turns`: from nothing to weights, and how good they are."""

import json
from pathlib import Path

import numpy as np

from relguide.learn.boundary.template_label_file import load_template_labels
from relguide.learn.boundary.turn_labels import TurnLabelRequest
from relguide.learn.boundary.turn_network import load_turn_network
from tests.command_line import Run

AUDIT = ("audit", "--method", "turns", "--count", "120", "--threads", "1")


def test_labels_train_weights(run: Run) -> None:
    data = ("dataset", "--method", "turns", "--out", "turns.npz", "--count", "300")
    code, out, err = run(*data, "--json", "--threads", "1")
    assert (code, err) == (0, "")
    told = json.loads(out)
    read, about = load_template_labels(Path("turns.npz"), kind="turns")
    assert told["labels"] == len(read) == sum(told["fastest"].values()) == 300
    assert list(told["sources"]) == ["tight", "near"]
    first = TurnLabelRequest(count=300, seed=7).make(0)
    assert np.array_equal(read.times[:250], first.times)
    assert about["provenance"]["command"] == (
        "relguide dataset --method turns --count 300 --seed 7 --out turns.npz"
    )
    size = ("--width", "16", "--depth", "1", "--epochs", "2", "--batch", "64", "--threads", "1")
    code, out, err = run(
        "train", "turns.npz", "w.safetensors", "--method", "turns", *size, "--table"
    )
    assert (code, err) == (0, "")
    assert "w.safetensors: the best of 2 epochs is the " in out
    made = load_turn_network(Path("w.safetensors"))
    assert made.about["command"].endswith(" --method turns")
    assert (made.box, made.most) == (load_turn_network().box, load_turn_network().most)
    other = run("train", "turns.npz", "v.safetensors", "--method", "templates")
    assert other[0] == 2
    assert "file of another kind: relguide turn labels 1" in other[2]


def test_people_get_tables(run: Run) -> None:
    code, out, err = run(*AUDIT, "--table")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert max(map(len, lines)) <= 100
    names = [line.split("  ")[0].strip() for line in lines]
    for name in ("tight", "near", "all"):
        assert name in names
    assert "Together: the network, and the search for what it passes on." in out


def test_programs_get_json(run: Run) -> None:
    code, out, err = run(*AUDIT, "--json")
    assert (code, err) == (0, "")
    told = json.loads(out)
    assert told["situations"] == 120
    assert told["groups"]["all"]["situations"] == told["judged"] <= 120
    assert told["groups"]["all"]["answered_without_a_path"]["hits"] == 0
    assert told["everywhere"] == {}


def test_misuse_is_said_in_a_sentence(run: Run) -> None:
    seed = load_turn_network().about["dataset"]["seed"]
    assert f"seen the situations of seed {seed}" in run(*AUDIT, "--seed", f"{seed}")[2]
    assert "--beside is for --method branches" in run(*AUDIT, "--beside", "10")[2]
    assert "no figure of this network" in run(*AUDIT, "--figures", "f")[2]
    assert "count and chunk must be" in run("audit", "--method", "turns", "--count", "0")[2]
