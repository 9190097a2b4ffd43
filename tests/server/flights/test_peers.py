"""Several processes that fly behind one address: whose flight is it, and who lists it?"""

from contextlib import ExitStack

import httpx2 as httpx
import pytest
from relguide_server.settings import settings_from

from tests.server.http.test_access import FLIGHT, SETTING, TOKENS
from tests.server.serving import ideal_app, serve


def start(address: str, token: str = "") -> str:
    headers = {"Authorization": f"Bearer {token}"} if token else {}
    url = f"http://{address}/api/v1/flights"
    started: str = httpx.post(url, json=FLIGHT, headers=headers).json()["id"]
    return started


def listed(address: str, **headers: str) -> tuple[list[str], list[str]]:
    answer = httpx.get(f"http://{address}/api/v1/flights", headers=headers).json()
    return [flight["id"] for flight in answer["flights"]], answer.get("missing", [])


def test_each_process_lists_the_flights_of_all() -> None:
    with ExitStack() as running:
        b = running.enter_context(serve(ideal_app(process="b")))
        gone = running.enter_context(ExitStack())
        c = gone.enter_context(serve(ideal_app(process="c")))
        peers = f"a=http://127.0.0.1:1,b=http://{b},c=http://{c}"
        a = running.enter_context(serve(ideal_app(process="a", peers=peers)))
        ids = [start(address) for address in (a, b, c)]
        assert [name[:2] for name in ids] == ["a-", "b-", "c-"]
        assert listed(a) == (ids, [])
        whole = httpx.get(f"http://{a}/api/v1/flights").json()
        assert whole["flights"][1]["stream_url"] == f"/api/v1/flights/{ids[1]}/stream"
        assert "missing" not in whole
        assert listed(a, **{"Relguide-Process": "a"}) == (ids[:1], [])
        assert listed(b) == (ids[1:2], [])  # it knows of no others
        gone.close()
        assert listed(a) == (ids[:2], ["c"])


def test_who_may_not_see_the_flights_of_one_process_sees_those_of_none() -> None:
    with serve(ideal_app(process="b", tokens=SETTING)) as b:
        flight = start(b, TOKENS["fly"])
        with serve(ideal_app(process="a", peers=f"b=http://{b}", tokens=SETTING)) as a:
            assert listed(a, Authorization=f"Bearer {TOKENS['view']}") == ([flight], [])
            assert listed(a, Cookie=f"relguide_token={TOKENS['view']}") == ([flight], [])
        with serve(ideal_app(process="a", peers=f"b=http://{b}")) as a:
            assert listed(a) == ([], ["b"])


def test_one_process_alone_has_ids_without_a_letter() -> None:
    with serve(ideal_app()) as address:
        assert "-" not in start(address)


@pytest.mark.parametrize(
    ("name", "value", "sentence"),
    [
        ("process", "ab", "must be a letter from a to z"),
        ("process", "1", "must be a letter from a to z"),
        ("peers", "http://flights-a:8000", "a=http://flights-a:8000"),
        ("peers", "a=http://flights-a:8000,", "a=http://flights-a:8000"),
        ("peers", "a=http://flights-a/api", "a=http://flights-a:8000"),
        ("peers", "a=file:///etc", "a=http://flights-a:8000"),
    ],
)
def test_a_process_that_is_named_wrongly_is_refused(name: str, value: str, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        settings_from(**{name: value})
