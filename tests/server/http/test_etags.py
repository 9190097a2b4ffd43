"""Documents and lists that change seldom are not sent again to who has them."""

import pytest

from tests.server.serving import TestClient, ideal_app


@pytest.mark.parametrize("path", ["/openapi.json", "/asyncapi.json", "/api/v1/scenarios"])
@pytest.mark.parametrize("root", ["", "/below"])
def test_who_has_it_is_not_sent_it_again(path: str, root: str) -> None:
    with TestClient(ideal_app(root_path=root)) as client:
        whole = client.get(root + path)
        tag = whole.headers["etag"]
        assert whole.json()
        assert whole.headers["content-type"] == "application/json"
        again = client.get(root + path, headers={"If-None-Match": f'"other", {tag}'})
        assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", tag)
        other = client.get(root + path, headers={"If-None-Match": '"other"'})
        assert (other.status_code, other.content) == (200, whole.content)


def test_what_differs_has_another_tag() -> None:
    tags = []
    for root in ("", "/below"):
        with TestClient(ideal_app(root_path=root)) as client:
            document = client.get(f"{root}/openapi.json")
            assert document.json().get("servers") == ([{"url": root}] if root else None)
            tags += [document.headers["etag"], client.get(f"{root}/asyncapi.json").headers["etag"]]
    assert len(set(tags)) == 4
