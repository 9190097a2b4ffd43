"""The browser's types are fresh, and the protocol changes when they do."""

import re
from pathlib import Path

import pytest

from relguide.contract.protocol import PROTOCOL, protocol, typescript_body
from tests.documents import DOCUMENT_TYPES
from tools.emit_types import COMMAND, WIRE_TS, main, wire_ts


def test_the_committed_file_is_fresh() -> None:
    fresh = WIRE_TS.read_text("utf-8") == wire_ts()
    assert fresh, f"{WIRE_TS.name} does not match the contract. Run: {COMMAND}"


def test_check_says_what_to_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "wire.ts"
    assert main(["--check", "--file", str(file)]) == 1
    assert f"Run: {COMMAND}" in capsys.readouterr().err
    assert not file.exists()
    assert main(["--file", str(file)]) == 0
    assert main(["--check", "--file", str(file)]) == 0
    file.write_text(file.read_text("utf-8").replace("number", "string", 1), "utf-8")
    assert main(["--check", "--file", str(file)]) == 1


def test_the_protocol_stands_in_the_file() -> None:
    assert re.fullmatch(r"relguide-[0-9a-f]{12}", PROTOCOL)
    assert f'export const PROTOCOL = "{PROTOCOL}";\n' in wire_ts()


def test_comments_do_not_change_the_protocol_but_shapes_do() -> None:
    assert "/**" in typescript_body(docs=True)
    assert "/**" not in typescript_body(docs=False)
    assert protocol("a") != protocol("b")
    assert protocol(typescript_body(docs=False)) == PROTOCOL


def test_every_document_has_its_interface_and_its_place_in_the_union() -> None:
    text = wire_ts()
    (union,) = re.findall(r"export type Document =([^;]*);", text)
    for document_type in DOCUMENT_TYPES:
        assert f"export interface {document_type.__name__} {{" in text
        assert re.search(rf"\b{document_type.__name__}\b", union)


def test_every_type_that_is_named_is_there() -> None:
    text = re.sub(r"/\*\*.*?\*/|\"[^\"]*\"|//[^\n]*", "", wire_ts(), flags=re.DOTALL)
    defined = set(re.findall(r"export (?:interface|type) (\w+)", text))
    assert set(re.findall(r"\b[A-Z][a-z]\w*", text)) <= defined


def test_lines_are_as_the_formatter_leaves_them() -> None:
    assert all(len(line) <= 100 for line in wire_ts().splitlines())
    assert wire_ts().endswith("}\n")


def test_no_field_in_degrees_is_said_to_be_in_radians() -> None:
    file = wire_ts()
    assert "_deg: number" in file
    assert "[rad]" not in file
