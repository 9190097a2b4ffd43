"""`relguide audit --method templates`: tables, JSON, a figure, and refusals."""

import json
from pathlib import Path
from xml.etree import ElementTree

from relguide.learn.boundary.template_network import load_template_network
from tests.command_line import Run

AUDIT = ("audit", "--method", "templates", "--count", "60", "--threads", "1")


def test_people_get_tables_and_a_figure(run: Run) -> None:
    code, out, err = run(*AUDIT, "--figures", "docs/figures", "--table")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert max(map(len, lines)) <= 100
    assert "…" not in out
    names = [line.split("  ")[0].strip() for line in lines]
    for name in ("tight", "near", "far", "along", "all", "it binds", "all situations"):
        assert name in names
    assert names.index("CPU time of one query, µs") < names.index("network")
    assert "Slower than the fastest path by more than 0.1 %: " in out
    assert "All situations, whether d_min binds or not: " in out
    assert "Of the answers: how much longer they take than the fastest path" in out
    (drawn,) = Path("docs/figures").iterdir()
    assert drawn.name == "network_templates.svg"
    picture = drawn.read_text("utf-8")
    assert "first choice right [%]" in picture
    assert ElementTree.fromstring(picture).tag.endswith("svg")


def test_programs_get_json(run: Run) -> None:
    code, out, err = run(*AUDIT, "--json")
    assert (code, err) == (0, "")
    told = json.loads(out)
    assert (told["situations"], told["seed"]) == (60, 1)
    assert told["groups"]["all"]["situations"] == 60
    assert told["groups"]["all"]["answered_without_a_path"]["hits"] == 0
    assert told["network"]["labels"] == load_template_network().about["labels"]
    for share in ("p50_us", "mean_us"):
        assert told["latency"]["network"][share] < told["latency"]["search"][share]


def test_misuse_is_said_in_a_sentence(run: Run) -> None:
    assert run("audit", "none.safetensors", "--method", "templates")[2] == (
        "relguide: none.safetensors: No such file or directory.\n"
    )
    seed = load_template_network().about["dataset"]["seed"]
    assert f"seen the situations of seed {seed}" in run(*AUDIT, "--seed", f"{seed}")[2]
    assert "--beside is for --method branches" in run(*AUDIT, "--beside", "10")[2]
    assert "count and chunk must be" in run("audit", "--method", "templates", "--count", "0")[2]
    Path("w.safetensors").write_bytes(b"no weights")
    assert (
        "holds no network of relguide train --method templates" in run(*AUDIT, "w.safetensors")[2]
    )
