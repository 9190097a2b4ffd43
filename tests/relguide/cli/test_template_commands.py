"""`relguide dataset --method templates` and `train --method templates`: from nothing to weights."""

import json
from pathlib import Path

import numpy as np

from relguide.learn.boundary.template_label_file import grow_template_labels, load_template_labels
from relguide.learn.boundary.template_labels import TemplateLabelRequest, template_label_chunk
from relguide.learn.boundary.template_network import load_template_network
from tests.command_line import Run
from tests.relguide.learn.boundary.test_template_labels import Here

LIMIT = ("dataset", "--method", "templates", "--out", "templates.npz", "--count", "500")


def test_labels_train_weights(run: Run) -> None:
    code, out, err = run(*LIMIT, "--json", "--threads", "1")
    assert (code, err) == (0, "")
    told = json.loads(out)
    read, about = load_template_labels(Path("templates.npz"))
    assert told["labels"] == len(read) == sum(told["fastest"].values()) == 500
    first = template_label_chunk(TemplateLabelRequest(count=500, seed=7), 0)
    assert np.array_equal(read.times[:250], first.times)
    assert about["provenance"]["command"] == (
        "relguide dataset --method templates --count 500 --seed 7 --out templates.npz"
    )
    size = ("--width", "16", "--depth", "1", "--epochs", "2", "--batch", "64", "--threads", "1")
    code, out, err = run(
        "train", "templates.npz", "w.safetensors", "--method", "templates", *size, "--table"
    )
    assert (code, err) == (0, "")
    assert "w.safetensors: the best of 2 epochs is the " in out
    assert load_template_network(Path("w.safetensors")).about["program"].startswith("relguide ")
    assert sorted(path.name for path in Path().iterdir()) == ["templates.npz", "w.safetensors"]


def test_labelling_goes_on_after_a_stop(run: Run) -> None:
    begun = grow_template_labels(
        TemplateLabelRequest(count=500, seed=7), Path("templates.npz.part"), Here(), resume=False
    )
    next(begun)
    begun.close()
    code, _, err = run(*LIMIT)
    assert code == 2
    assert "--resume goes on with it" in err
    code, out, _ = run(*LIMIT, "--resume", "--table")
    assert code == 0
    assert out.startswith("templates.npz: 500 situations in which d_min binds, ")
    assert not Path("templates.npz.part").exists()


def test_labels_of_another_kind_are_refused(run: Run) -> None:
    run("dataset", "--method", "exact", "--out", "labels.npz", "--count", "300")
    code, _, err = run("train", "labels.npz", "w.safetensors", "--method", "templates")
    assert code == 2
    assert "file of another kind: relguide exact labels 1" in err
