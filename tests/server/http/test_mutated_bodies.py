"""Bodies with something wrong: each route answers or refuses, in our words, and never breaks."""

import copy
import json
import re
from collections.abc import Iterator
from random import Random
from typing import Any

import pytest
from relguide_server.app import create_app
from relguide_server.settings import ServiceSettings

from tests.server.serving import TestClient, ideal_catalogue

VALUES: list[Any] = [
    None, True, 0, -1, 0.5, 1e308, 10**400, 1e-320, "", "x", "é😀\u202e", "\ud800", "12", [], {},
    [[]], [None], {"a": 1}, "x" * 5000, [1] * 200, float("nan"), float("inf"), "left",
]  # fmt: skip
"""What a field is given."""
NAMES = ["x_nm", "tas_kt", "", "\ud800", "__class__", "kind"]
"""What a field is called that is none."""
NOT_OURS = re.compile(r"pydantic|Input should|Extra inputs|NoneType|<class|literal\[|#[a-z]|Error")
SAYS_WHAT_IS_RIGHT = re.compile(
    r"must|leave it out|did you mean|give |is missing: it|belongs in|there are|try again|lists all"
    r"|too large|not JSON|send|once|take control|whose area"
)


def places(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The path of each part of a body, but of the whole."""
    parts: Any = ()
    if isinstance(value, dict):
        parts = value.items()
    elif isinstance(value, list):
        parts = enumerate(value)
    for key, part in parts:
        yield (*path, key)
        yield from places(part, (*path, key))


def mutated(rng: Random, body: Any) -> Any:
    """A body with one thing changed."""
    body = copy.deepcopy(body)
    *way, last = rng.choice(list(places(body)))
    here = body
    for step in way:
        here = here[step]
    match rng.randrange(4):
        case 0:
            del here[last]
        case 1 if isinstance(here, dict):
            here[rng.choice(NAMES)] = rng.choice(VALUES)
        case _:
            here[last] = rng.choice(VALUES)
    return body


@pytest.mark.slow
def test_what_is_wrong_is_refused_in_our_words_and_nothing_breaks() -> None:
    app = create_app(ServiceSettings(workers=0), catalogue=ideal_catalogue())
    rng, refused = Random(6), 0
    with TestClient(app) as client:
        started = client.post("/api/v1/flights", json={"scenario": "ideal", "paused": True})
        for path, methods in app.openapi()["paths"].items():
            for method, operation in methods.items():
                media = operation.get("requestBody", {}).get("content", {}).get("application/json")
                if media is None:
                    continue
                given = [one["value"] for one in media.get("examples", {}).values()]
                given += [media["example"]] if "example" in media else []
                url = path.replace("{flight_id}", started.json()["id"])
                for _ in range(40):
                    text = json.dumps(mutated(rng, rng.choice(given)))
                    answer = client.request(
                        method, url, content=text, headers={"Content-Type": "application/json"}
                    )
                    if answer.status_code < 400 or answer.status_code in (404, 429):
                        continue
                    assert answer.status_code in (400, 409, 422), (url, text[:500], answer.text)
                    problem = answer.json()
                    for one in problem["errors"] or [{"path": "", "message": problem["detail"]}]:
                        said = f"{one['path']}: {one['message']}"
                        assert not NOT_OURS.search(said), (url, text[:500], said)
                        assert SAYS_WHAT_IS_RIGHT.search(one["message"]), (url, text[:500], said)
                        refused += 1
    assert refused > 300
