"""`relguide plan --batch`: files in and out, their order, bad lines, and what is refused."""

import csv
import json
import sys
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from relguide.cli.batch import order as orders
from relguide.cli.batch.order import form_of
from relguide.cli.batch.source import text_chunks
from tests.bodies import AMID, BODY, change, on_earth
from tests.command_line import UNREACHABLE, Run, write
from tests.relguide.contract.test_flat import flat

PLAIN = change("leader.intent", ...)
BODIES = [
    {"id": n, **body}
    for n, body in enumerate(
        (PLAIN, BODY, UNREACHABLE, on_earth((48.0, 2.0), (48.3, 2.5)), change("wind", ...), AMID)
        * 3
    )
]
"""Plain situations, intents, latitudes, others, and some without a plan."""


def jsonl(bodies: list[dict[str, Any]], name: str = "all.jsonl") -> str:
    return write("".join(json.dumps(body) + "\n" for body in bodies), name)


def as_csv(bodies: list[dict[str, Any]], name: str = "all.csv") -> str:
    rows = [flat(body) for body in bodies]
    columns = list(dict.fromkeys(column for row in rows for column in row))
    with Path(name).open("w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)
    return name


def as_parquet(bodies: list[dict[str, Any]], name: str = "all.parquet") -> str:
    rows = [flat(body) for body in bodies]
    columns = dict.fromkeys(column for row in rows for column in row)
    table = {column: [row.get(column) for row in rows] for column in columns}
    pq.write_table(pa.table(table), name, row_group_size=4)
    return name


def without_time(answers: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Answers less what they took to compute."""
    return [{k: v for k, v in answer.items() if k != "compute_ms"} for answer in answers]


def rounded(answer: dict[str, Any]) -> dict[str, Any]:
    """Its numbers to a microsecond."""
    cells = flat(answer)
    return {k: round(v, 6) if isinstance(v, float) else v for k, v in cells.items()}


def lines_of(file: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in Path(file).read_text().splitlines()]


@pytest.fixture
def small_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(orders, "AT_ONCE", {"times": 4, "plan": 2, "full": 1})


@pytest.mark.parametrize("fields", ["times", "plan", "full"])
@pytest.mark.parametrize("make", [jsonl, as_csv, as_parquet])
@pytest.mark.usefixtures("small_chunks")
def test_answers_are_the_same_from_every_form(run: Run, make: Any, fields: str) -> None:
    include = ("--include", "alternatives,optimality") if fields == "full" else ()
    if fields == "times":
        expected = []
        for body in BODIES:
            reply = json.loads(run("plan", write(body))[1])
            kept = ("id", "status", "reason", "lower_bound_s", "time_to_converge_s", "optimality")
            expected.append({name: reply[name] for name in kept if name in reply})
    else:
        expected = [json.loads(run("plan", write(body), *include)[1]) for body in BODIES]
    if make is as_csv:  # where all is text
        expected = [{**answer, "id": str(answer["id"])} for answer in expected]
    options = ("--fields", fields, "--processes", "1")
    code, out, err = run("plan", "--batch", make(BODIES), *options)
    assert (code, err) == (0, "")
    found = [json.loads(line) for line in out.splitlines()]
    if fields == "times":
        assert [rounded(answer) for answer in found] == [rounded(answer) for answer in expected]
    else:
        assert without_time(found) == without_time(expected)


@pytest.mark.parametrize("fields", ["times", "plan", "full"])
@pytest.mark.usefixtures("small_chunks")
def test_csv_and_parquet_hold_what_json_lines_hold(run: Run, fields: str) -> None:
    bodies = [*BODIES, {"id": 99}]
    for name in ("out.jsonl", "out.csv", "out.parquet"):
        options = ("--out", name, "--fields", fields, "--processes", "1")
        code, out, err = run("plan", "--batch", as_parquet(bodies), *options)
        assert code == 1
        assert out.startswith(f"{name}: 19 answers, in ")
        assert err == "relguide: 1 line is no valid situation, the first is line 19.\n"
    expected = [flat(answer) for answer in lines_of("out.jsonl")]
    table = pq.read_table("out.parquet")
    assert table.schema.field("id").type == pa.int64()
    assert table.schema.field("optimality.lower_bound_s").type == pa.float64()
    columnar = table.to_pylist()
    with Path("out.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(expected) == len(columnar) == len(rows) == 19
    for answer, cells, texts in zip(expected, columnar, rows, strict=True):
        held = {name: cell for name, cell in cells.items() if cell is not None}
        assert held.keys() == answer.keys() == {name for name, text in texts.items() if text}
        for name, value in answer.items():
            if name != "compute_ms":
                if isinstance(value, str) and value.startswith("["):
                    assert json.loads(held[name]) == json.loads(value)
                    assert json.loads(texts[name]) == json.loads(value)
                else:
                    assert held[name] == value
                    assert texts[name] == str(value)
    assert not list(Path().glob("*.part*"))


@pytest.mark.parametrize("to", ["csv", "parquet"])
def test_columns_for_others_are_there_only_where_situations_have_them(run: Run, to: str) -> None:
    plain = run("plan", "--batch", jsonl(BODIES[:5]), "--to", to, "--out", f"plain.{to}")
    amid = run("plan", "--batch", jsonl(BODIES[:6]), "--to", to, "--out", f"amid.{to}")
    assert (plain[0], amid[0]) == (0, 0)
    columns = []
    for name in (f"plain.{to}", f"amid.{to}"):
        if to == "csv":
            columns.append(Path(name).read_text().splitlines()[0].split(","))
        else:
            columns.append(pq.read_schema(name).names)
    assert not [name for name in columns[0] if "others" in name or "conflict" in name]
    assert [name for name in columns[1] if name in columns[0]] == columns[0]
    assert {"separation.others", "conflict.ident", "remedies"} <= set(columns[1])


def test_structs_of_parquet_are_the_objects_of_json(run: Run) -> None:
    """As pyarrow and others write nested JSON."""
    bodies = [{"id": "a", **BODY}, {"id": "b", **change("wind", ...)}]
    pq.write_table(pa.Table.from_pylist(bodies), "nested.parquet")
    found = [json.loads(x) for x in run("plan", "--batch", "nested.parquet")[1].splitlines()]
    expected = [json.loads(x) for x in run("plan", "--batch", jsonl(bodies))[1].splitlines()]
    assert without_time(found) == without_time(expected)
    assert {answer["status"] for answer in found} == {"planned"}


@pytest.mark.usefixtures("small_chunks")
def test_a_bad_line_of_csv_spoils_itself_alone(run: Run) -> None:
    good = Path(as_csv(BODIES[:2])).read_text().splitlines()
    header, line, intent = good
    cells = line.split(",")
    bad = [
        f'"{line}',  # a quote that is not closed
        ",".join(cells[:-1]),
        line.replace("-40000", "far"),
        intent.replace("straight_s", "straight"),
        f"{line},",
    ]
    lines = [f"\ufeff{header}", line, bad[0], intent, *bad[1:], "", line]
    Path("bad.csv").write_bytes("\r\n".join(lines).encode() + b"\r\n\xff\r\n")
    options = ("--fields", "times", "--processes", "1")
    code, out, err = run("plan", "--batch", "bad.csv", *options)
    answers = [json.loads(line) for line in out.splitlines()]
    assert code == 1
    assert [answer["status"] for answer in answers] == [
        "planned", "invalid", "planned", *["invalid"] * 4, "planned", "invalid",
    ]  # fmt: skip
    assert [answer["line"] for answer in answers if "line" in answer] == [3, 5, 6, 7, 8, 11]
    said = [answer["message"] for answer in answers if "line" in answer]
    assert said[0] == "This is not a line of CSV: unexpected end of data."
    assert (
        said[1]
        == f"This line must have {len(cells)} cells, as the first has, not {len(cells) - 1}."
    )
    assert said[2] == 'pursuer.x_m: must be a number, not the text "far".'
    assert said[5] == "This is not UTF-8 text: byte 0 cannot be read."
    assert err == "relguide: 6 lines are no valid situation, the first is line 3.\n"


def test_forms_are_known_by_their_endings_or_as_chosen(run: Run) -> None:
    assert [form_of(name, None) for name in ("a.csv", "A.CSV", "a.parquet", "a.pq")] == [
        "csv", "csv", "parquet", "parquet",
    ]  # fmt: skip
    assert [form_of(name, None) for name in ("a.jsonl", "a.ndjson", "-", "", "a")] == ["jsonl"] * 5
    Path(as_csv(BODIES[:1])).rename("situations.txt")
    code, out, _ = run(
        "plan", "--batch", "situations.txt", "--from", "csv", "--to", "csv", "--fields", "times"
    )
    assert code == 0
    header, row = csv.reader(out.splitlines())
    assert dict(zip(header, row, strict=True))["status"] == "planned"


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("a.jsonl", "--out", "a.csv"), "--out is for a file of situations: add --batch."),
        (("a.jsonl", "--fields", "times"), "--fields is for a file of situations: add --batch."),
        (("--batch", "a.jsonl", "--table"), "A batch is answered in rows: leave out --table."),
        (("--batch", "a.jsonl", "--to", "parquet"), "Parquet is not written to standard output"),
        (("--batch", "a.jsonl", "--resume"), "Only a run with --out FILE leaves something"),
        (("--batch", "a.jsonl", "--out", "./a.jsonl"), "would take the place of the situations"),
        (("--batch", "a.jsonl", "--out", "b.jsonl", "--resume"), "There is nothing to resume"),
        (("--batch", "a.jsonl", "--out", "no/b.jsonl"), "no/b.jsonl.part"),
        (("--batch", "a.jsonl", "--fields", "times", "--prove", "1"), "Times have nothing that"),
        (("--batch", "a.jsonl", "--from", "parquet"), "a.jsonl is no Parquet file: "),
        (("--batch", "-", "--from", "parquet"), "Parquet is not read from standard input"),
        (("--batch", "a.jsonl", "--from", "csv"), "a.jsonl has the column "),
        (("--batch", "empty.csv"), "the first line of a CSV file must name its columns"),
        (("--batch", "none.parquet"), "none.parquet"),
        (("--batch", "a.jsonl", "--fields", "all"), "invalid choice: 'all'"),
        (("--batch", "a.jsonl", "--processes", "-1"), "must be a whole number of 0 or more"),
    ],
)
def test_misuse_is_said_in_a_sentence(run: Run, arguments: tuple[str, ...], sentence: str) -> None:
    jsonl([PLAIN], "a.jsonl")
    write("", "empty.csv")
    code, out, err = run("plan", *arguments)
    assert (code, out) == (2, "")
    assert sentence in err
    assert sorted(path.name for path in Path().iterdir()) == ["a.jsonl", "empty.csv"]


@pytest.mark.parametrize("arguments", [("a.jsonl", "--out", "b.parquet"), ("a.parquet",)])
def test_without_pyarrow_it_is_said_what_to_install(
    run: Run, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...]
) -> None:
    jsonl([PLAIN], "a.jsonl")
    as_parquet([PLAIN], "a.parquet")
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert run("plan", "--batch", *arguments) == (
        2, "", "relguide: This needs the package pyarrow, which is not installed: "
        "pip install 'relguide[parquet]' brings it.\n",
    )  # fmt: skip


def test_a_line_without_end_is_refused(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("relguide.cli.batch.source.LONGEST", 1 << 20)
    write("x" * (3 << 20), "long.jsonl")
    code, _, err = run("plan", "--batch", "long.jsonl")
    assert (code, err) == (
        2, "relguide: Line 1 is longer than 1 MiB: this is no file of situations.\n",
    )  # fmt: skip


@pytest.mark.parametrize("at_once", [1, 2, 3, 100])
def test_chunks_are_whole_lines_and_leave_nothing_out(
    at_once: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("relguide.cli.batch.source.BLOCK", 7)
    content = b"".join(b"%d\n" % 10**n for n in range(20)) + b"\n\nend"
    (tmp_path / "a").write_bytes(content)
    with (tmp_path / "a").open("rb") as stream:
        chunks = [chunk for chunk in text_chunks(stream, 1, at_once) if chunk is not None]
    assert b"".join(chunk.content for chunk in chunks) == content
    assert sum(chunk.size for chunk in chunks) == len(content)
    first = 1
    for chunk in chunks:
        assert chunk.first == first
        assert 1 <= chunk.lines <= at_once
        assert len(chunk.content.splitlines()) == chunk.lines
        first += chunk.lines
    assert chunks[-1].content.endswith(b"end")
