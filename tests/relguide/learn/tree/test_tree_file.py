"""Trees as files: read back whole, without pickle, and refused with a sentence where damaged."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from relguide.learn.tree.reverse_dp import grow_order, plant
from relguide.learn.tree.tree import parameters_as_json, parameters_from_json
from relguide.learn.tree.tree_file import (
    TREE_COLUMNS,
    load_growth,
    load_tree,
    save_growth,
    save_tree,
)
from tests.relguide.learn.tree.trees import parameters, tree


def test_a_tree_comes_back_as_it_was(tmp_path: Path) -> None:
    file = tmp_path / "tree.npz"
    made = replace(tree(), provenance={"program": "a test", "made": "today"})
    save_tree(made, file)
    read = load_tree(file)
    assert read.parameters == made.parameters
    assert (read.laid, read.close) == (made.laid, made.close)
    assert read.provenance == made.provenance
    for field in TREE_COLUMNS.values():
        assert np.array_equal(getattr(read, field), getattr(made, field))
        assert getattr(read, field).dtype == getattr(made, field).dtype
    assert [path.name for path in tmp_path.iterdir()] == ["tree.npz"]


def test_the_file_is_plain_arrays(tmp_path: Path) -> None:
    save_tree(tree(), tmp_path / "tree.npz")
    with np.load(tmp_path / "tree.npz", allow_pickle=False) as content:
        assert all(content[name].dtype.kind in "ifU" for name in content.files)
        assert json.loads(str(content["about"]))["parameters"]["order"] == 3


def test_a_growing_tree_comes_back_as_it_was(tmp_path: Path) -> None:
    *_, growth = grow_order(plant(parameters()))
    save_growth(growth, tmp_path / "tree.npz.part")
    read = load_growth(tmp_path / "tree.npz.part")
    for field in growth.__slots__:
        assert np.array_equal(getattr(read, field), getattr(growth, field))


def test_parameters_come_back_to_the_last_digit() -> None:
    again = parameters_from_json(json.loads(json.dumps(parameters_as_json(parameters()))))
    assert parameters_as_json(again) == parameters_as_json(parameters())
    assert again.delta_theta == pytest.approx(parameters().delta_theta, rel=1e-15)
    with pytest.raises(ValueError, match="are not whole: 'cell_m'"):
        parameters_from_json(
            {k: v for k, v in parameters_as_json(parameters()).items() if k != "cell_m"}
        )


def test_what_is_no_tree_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "tree.npz"
    save_tree(tree(), file)
    whole = file.read_bytes()
    for damaged in (b"", b"nonsense", whole[: len(whole) // 2]):
        file.write_bytes(damaged)
        with pytest.raises(ValueError, match=r"tree\.npz is no file of relguide dataset"):
            load_tree(file)
    np.savez(file, about=np.array('{"file": "other"}'))
    with pytest.raises(ValueError, match="of another kind: other, not relguide reverse-dp tree 1"):
        load_tree(file)
    np.savez(file, about=np.array({"file": "relguide"}, dtype=object))
    with pytest.raises(ValueError, match=r"tree\.npz"):
        load_tree(file)
    save_growth(plant(parameters()), file)
    with pytest.raises(ValueError, match="another kind: relguide reverse-dp growth 1"):
        load_tree(file)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("parent", 10**6),
        ("best", 10**6),
        ("best", -2),
    ],
)
def test_columns_that_do_not_fit_are_refused(tmp_path: Path, field: str, value: int) -> None:
    column = getattr(tree(), field).copy()
    column.flat[0] = value
    save_tree(replace(tree(), **{field: column}), tmp_path / "tree.npz")
    with pytest.raises(ValueError, match="its columns do not fit together"):
        load_tree(tmp_path / "tree.npz")
