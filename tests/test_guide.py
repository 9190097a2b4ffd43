"""The guide: its pages run and print what they show, and its site is built without a warning."""

import ast
import doctest
import io
import json
import re
import xml.etree.ElementTree as ET
from contextlib import redirect_stdout
from importlib import import_module
from pathlib import Path
from types import FunctionType
from typing import get_args

import pytest
from relguide_server.app import create_app
from relguide_server.settings import ServiceSettings

import relguide
from tests.pages import ROOT, build_site, run_page
from tests.relguide.parallel.dask_cluster import local_cluster
from tests.server.serving import serve

DOCS = ROOT / "docs"
STEPS = sorted((DOCS / "tutorial").glob("*.md"))
HOW_TO = sorted((DOCS / "howto").glob("*.md"))
APART = {"cluster", "proxy"}
"""Pages that need a service or a cluster."""
NOTEBOOKS = sorted((ROOT / "examples").glob("*.ipynb"))
REFERENCE = sorted((DOCS / "reference").glob("*.md"))
DOCUMENTS = {kind.__name__ for kind in get_args(relguide.Document)}
ORDERS = {kind.__name__ for kind in get_args(relguide.Command)}
"""Their docstrings are also those of JSON, which has no Python: others' examples give them."""
RESULTS = {
    "Alternative", "Arrival", "Candidate", "Certificate", "Isochrones", "Optimality",
    "OptimalityReport", "Samples", "TimeRow", "Times",
}  # fmt: skip
"""Made by functions, whose examples show them."""
WITHOUT_EXAMPLE = DOCUMENTS | ORDERS | RESULTS


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def expect_shown(said: list[tuple[str, str]]) -> None:
    assert said
    for printed, shown in said:
        assert printed == shown


@pytest.mark.slow
@pytest.mark.parametrize(
    "page", [*STEPS, *(p for p in HOW_TO if p.stem not in APART)], ids=lambda page: page.stem
)
def test_a_page_prints_what_it_shows(page: Path, folder: Path) -> None:
    expect_shown(run_page(page, folder))


def test_a_client_asks_through_a_proxys_path(folder: Path) -> None:
    app = create_app(ServiceSettings(workers=0, root_path="/relguide"))
    with serve(app) as address:
        instead = {"https://example.org": f"http://{address}"}
        expect_shown(run_page(DOCS / "howto" / "proxy.md", folder, instead))


@pytest.mark.slow
def test_a_cluster_flies_a_campaign(folder: Path) -> None:
    with local_cluster(folder) as found:
        found.add_worker()
        instead = {"tcp://HOST:8786": found.address}
        expect_shown(run_page(DOCS / "howto" / "cluster.md", folder, instead))


@pytest.mark.parametrize("page", HOW_TO, ids=lambda page: page.stem)
def test_how_to_is_short(page: Path) -> None:
    prose = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
    assert len(prose.split()) <= 150


@pytest.mark.slow
@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda notebook: notebook.stem)
def test_a_notebook_prints_what_it_shows_and_draws_itself(notebook: Path, folder: Path) -> None:
    names: dict[str, object] = {}
    cells = json.loads(notebook.read_text())["cells"]
    for cell in (cell for cell in cells if cell["cell_type"] == "code"):
        *steps, last = ast.parse("".join(cell["source"])).body
        printed, value = io.StringIO(), None
        with redirect_stdout(printed):
            if isinstance(last, ast.Expr):
                exec(compile(ast.Module(steps, []), notebook.name, "exec"), names)
                value = eval(compile(ast.Expression(last.value), notebook.name, "eval"), names)
            else:
                exec(compile(ast.Module([*steps, last], []), notebook.name, "exec"), names)
        shown = "".join("".join(output.get("text", "")) for output in cell["outputs"])
        assert printed.getvalue() == shown
        drawings = [
            output for output in cell["outputs"] if "image/svg+xml" in output.get("data", "")
        ]
        assert (value is not None) == bool(drawings)
        for drawing in drawings:
            ET.fromstring("".join(drawing["data"]["image/svg+xml"]))
            assert value._repr_svg_().startswith("<svg")  # type: ignore[union-attr]


def test_each_public_name_stands_once_in_the_reference() -> None:
    named = re.findall(r"^::: relguide\.(\w+)$", "".join(map(Path.read_text, REFERENCE)), re.M)
    assert sorted(named) == sorted(relguide.__all__)


@pytest.mark.parametrize("module", sorted(set(relguide._HOMES.values())))
def test_examples_of_public_names_are_right(module: str, folder: Path) -> None:
    public = {name for name, home in relguide._HOMES.items() if home == module}
    finder, names = doctest.DocTestFinder(), {"rg": relguide}
    for found in finder.find(import_module(module), globs=names):
        if found.name.removeprefix(f"{module}.").partition(".")[0] in public:
            result = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(found)
            assert result.failed == 0, found.name


def test_each_public_name_that_is_called_has_an_example() -> None:
    finder, shown = doctest.DocTestFinder(), dict[str, str]()
    for name in relguide.__all__:
        value = getattr(relguide, name)
        if isinstance(value, type | FunctionType):
            found = finder.find(value, name)
            shown[name] = "".join(example.source for test in found for example in test.examples)
    assert {name for name, example in shown.items() if not example} == WITHOUT_EXAMPLE & {*shown}
    everywhere = "".join(shown.values())
    assert [name for name in sorted(ORDERS & {*shown}) if f"rg.{name}(" not in everywhere] == []


def test_each_page_is_in_the_navigation() -> None:
    (nav,) = re.findall(r"^nav:\n(.*)", (ROOT / "mkdocs.yml").read_text(), re.DOTALL | re.M)
    named = re.findall(r"[\w/-]+\.md", nav)
    decisions = {f"decisions/{file.name}" for file in (DOCS / "decisions").glob("[0-9]*.md")}
    held = {file.relative_to(DOCS).as_posix() for file in DOCS.rglob("*.md")}
    assert sorted(named) == sorted(held - decisions)


@pytest.mark.slow
def test_the_site_is_built_without_a_warning_and_asks_no_other_machine(tmp_path: Path) -> None:
    site = build_site(tmp_path)
    for page in site.rglob("*.html"):
        text = page.read_text()
        assert not re.search(r'<(?:script|link|img|iframe)[^>]*(?:src|href)="(?:https?:)?//', text)
        for link in re.findall(r'(?:href|src)="([^"#?]+)', text):
            if not re.match(r"https?:|data:|mailto:", link):
                to = site / link.lstrip("/") if link.startswith("/") else page.parent / link
                assert to.exists(), f"{page.relative_to(site)}: {link}"
