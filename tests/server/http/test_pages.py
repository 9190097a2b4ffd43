"""The built page: found, cached, packed, and a clear word when it has not been built."""

from pathlib import Path

import pytest
from relguide_server.http.pages import Page
from starlette.applications import Starlette
from starlette.testclient import TestClient


@pytest.fixture
def dist(tmp_path: Path) -> Path:
    folder = tmp_path / "dist"
    (folder / "assets").mkdir(parents=True)
    (folder / "index.html").write_text("<!doctype html><title>cockpit</title>")
    (folder / "assets" / "index-abc123.js").write_text("let a = 1;\n" * 500)
    (folder / ".inputs").write_text("secret of the build")
    (tmp_path / "outside.txt").write_text("not to be served")
    return folder


def client_of(*folders: Path) -> TestClient:
    return TestClient(Page(Starlette(), folders=folders))


def test_index_is_always_asked_for_anew_and_assets_never(dist: Path) -> None:
    client = client_of(dist)
    index = client.get("/")
    assert index.status_code == 200
    assert "cockpit" in index.text
    assert index.headers["cache-control"] == "no-cache"
    asset = client.get("/assets/index-abc123.js")
    assert "immutable" in asset.headers["cache-control"]
    assert asset.headers["content-encoding"] == "gzip"
    assert asset.text.startswith("let a")
    assert "javascript" in asset.headers["content-type"]


def test_the_controllers_page_has_an_address_of_its_own(dist: Path) -> None:
    client = client_of(dist)
    assert client.get("/atc").status_code == 503
    (dist / "atc.html").write_text("<!doctype html><title>atc</title>")
    client = client_of(dist)
    page = client.get("/atc")
    assert page.status_code == 200
    assert "atc" in page.text
    assert page.headers["cache-control"] == "no-cache"
    # what it names is relative to the root
    climbed = client.get("/atc/", follow_redirects=False)
    assert (climbed.status_code, climbed.headers["location"]) == (307, "/atc")


def test_what_is_made_for_other_pages_may_be_loaded_by_them(dist: Path) -> None:
    (dist / "embed").mkdir()
    (dist / "embed" / "relguide-nd.js").write_text("let a = 1;\n" * 500)
    client = client_of(dist)
    element = client.get("/embed/relguide-nd.js")
    assert element.headers["access-control-allow-origin"] == "*"
    assert element.headers["cache-control"] == "no-cache"
    assert "javascript" in element.headers["content-type"]
    again = client.get("/embed/relguide-nd.js", headers={"If-None-Match": element.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")
    assert "access-control-allow-origin" not in client.get("/").headers


def test_unchanged_files_are_not_sent_again(dist: Path) -> None:
    client = client_of(dist)
    tag = client.get("/").headers["etag"]
    again = client.get("/", headers={"If-None-Match": tag})
    assert (again.status_code, again.content) == (304, b"")


def test_a_client_that_cannot_unpack_gets_it_plain(dist: Path) -> None:
    client = client_of(dist)
    client.get("/")
    plain = client.get("/assets/index-abc123.js", headers={"Accept-Encoding": "identity"})
    assert "content-encoding" not in plain.headers


@pytest.mark.parametrize("path", ["/.inputs", "/../outside.txt", "/%2e%2e/outside.txt", "/x"])
def test_nothing_else_is_served(dist: Path, path: str) -> None:
    client = client_of(dist)
    client.get("/")
    assert client.get(path).status_code == 404


def test_a_page_built_anew_is_served_without_a_restart(dist: Path, tmp_path: Path) -> None:
    client = client_of(tmp_path / "installed", dist)
    assert "cockpit" in client.get("/").text
    other = tmp_path / "installed"
    other.mkdir()
    (other / "index.html").write_text("newer")
    assert client.get("/").text == "newer"


def test_an_unbuilt_page_says_what_to_do(tmp_path: Path) -> None:
    answer = client_of(tmp_path / "nowhere").get("/")
    assert answer.status_code == 503
    assert "has not been built" in answer.text
    assert "/docs" in answer.text
