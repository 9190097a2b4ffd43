"""The guide: found, strict, cached, and a clear word when it has not been built."""

import re
from base64 import b64encode
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

import pytest
from relguide_server.http import guide
from relguide_server.http.pages import Page

from tests.server.serving import TestClient, ideal_app

SCRIPT = "let scope = 1"


@pytest.fixture
def client(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[TestClient]:
    built = tmp_path / "built"
    (built / "start").mkdir(parents=True)
    (built / "index.html").write_text(f"<title>relguide</title><script>{SCRIPT}</script>")
    (built / "start" / "index.html").write_text("<p>Install</p>" * 200)
    (built / "search.json").write_text("{}")
    (tmp_path / "outside.txt").write_text("not to be served")
    monkeypatch.setattr(guide, "GUIDE_FOLDERS", (tmp_path / "no wheel", built))
    with TestClient(ideal_app()) as opened:
        yield opened


def test_its_pages_are_folders(client: TestClient) -> None:
    assert client.get("/guide/").text.startswith("<title>relguide")
    assert client.get("/guide/start/").text.startswith("<p>Install")
    for name in ("/guide", "/guide/start"):
        moved = client.get(name, follow_redirects=False)
        assert (moved.status_code, moved.headers["location"]) == (307, f"{name}/")


def test_only_scripts_of_its_own_run(client: TestClient) -> None:
    policy = client.get("/guide/").headers["content-security-policy"]
    known = b64encode(sha256(SCRIPT.encode()).digest()).decode()
    assert f"script-src 'self' 'sha256-{known}';" in policy
    assert "script-src 'self';" in client.get("/guide/start/").headers["content-security-policy"]
    assert "unsafe-eval" not in policy


def test_unchanged_pages_are_not_sent_again(client: TestClient) -> None:
    first = client.get("/guide/start/")
    assert first.headers["content-encoding"] == "gzip"
    assert first.headers["cache-control"] == "no-cache"
    again = client.get("/guide/start/", headers={"If-None-Match": first.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")


@pytest.mark.parametrize(
    "name",
    [
        "x",
        "x/",
        "../outside.txt",
        "%2e%2e/outside.txt",
        "start/x",
        "%00",
        "x" * 300,
        "%ff",
        "..%2f",
    ],
)
def test_nothing_else_is_served(client: TestClient, name: str) -> None:
    assert client.get(f"/guide/{name}").status_code == 404


def test_an_unbuilt_guide_says_what_to_do(
    client: TestClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guide, "GUIDE_FOLDERS", (tmp_path / "nowhere",))
    refused = client.get("/guide/")
    assert refused.status_code == 404
    assert "make guide" in refused.json()["detail"]


def test_the_pages_say_whether_there_is_a_guide(
    client: TestClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A link shown without it would lead nowhere."""
    page = tmp_path / "page"
    page.mkdir()
    (page / "index.html").write_text("<title>cockpit</title>")
    cockpit = TestClient(Page(ideal_app(), folders=(page,)))
    assert cockpit.head("/").headers["link"] == '<guide/>; rel="help"'
    assert "link" not in cockpit.get("/guide/").headers
    monkeypatch.setattr(guide, "GUIDE_FOLDERS", (tmp_path / "nowhere",))
    assert "link" not in cockpit.head("/").headers


def test_a_page_built_anew_is_served_without_a_restart(client: TestClient, tmp_path: Path) -> None:
    before = client.get("/guide/").headers["etag"]
    (tmp_path / "built" / "index.html").write_text("newer")
    after = client.get("/guide/")
    assert (after.text, after.headers["etag"] != before) == ("newer", True)
    assert re.fullmatch('"[0-9a-f]{20}"', before)
