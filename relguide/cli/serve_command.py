"""`relguide serve`: the service and the cockpit."""

import argparse
import socket
from importlib import import_module
from textwrap import fill, indent
from typing import Any

from relguide.cli.output import DONE, FAILED, say, write
from relguide.planning.extras import need

PURPOSE = "start the service and the cockpit"
EXAMPLES = """
    relguide serve                            on http://127.0.0.1:8000
    relguide serve --host 0.0.0.0 --port 80   for other machines too
    relguide serve --planner network --max-flights 4 --log-format json
    """
NEEDED = ("fastapi", "uvicorn", "viser", "orjson", "websockets", "sqlalchemy", "alembic",
          "pydantic_settings", "prometheus_client")  # fmt: skip


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide serve`: an address, and all settings of the service."""
    parser.add_argument("--host", default="127.0.0.1", help="default: %(default)s")
    parser.add_argument("--port", type=_port, default=8000, help="default: %(default)s")
    parser.add_argument(
        "--check", action="store_true", help="say what a start would do to records, and end"
    )
    need(*NEEDED)
    options = _server("settings").options()
    settings = parser.add_argument_group(
        "settings", "each can be given by a variable of the environment as well"
    )
    for option in options:
        if option.flag:
            said = option.help.replace("%", "%%")
            settings.add_argument(option.flag, metavar=option.unit, help=said)
    parser.add_argument_group(
        "from the environment alone, as options are seen by everybody on the machine",
        "\n".join(
            f"{option.variable} {option.unit}\n{indent(fill(option.help, 72), 22 * ' ')}"
            for option in options
            if not option.flag
        ),
    )


def run(chosen: argparse.Namespace) -> int:
    """Serve until stopped; an address that cannot be used is an OSError."""
    given = {
        option.name: text
        for option in _server("settings").options()
        if (text := getattr(chosen, option.name, None)) is not None
    }
    settings = _server("settings").settings_from(**given)
    host, port = chosen.host, chosen.port
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family) as probe:  # uvicorn would say it in a log line, and exit
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError as error:
            raise OSError(error.errno, error.strerror, f"{host}, port {port}") from None
    if chosen.check:
        return _check(settings)
    app = _server("app").app_of(settings, exposed=not _is_loopback(host))
    shown = f"[{host}]" if ":" in host else host
    write(f"relguide is on http://{shown}:{port}{settings.root_path} (Ctrl-C stops it)\n")
    warning = open_to_all(host, settings.tokens, settings.open_control)
    if warning:
        say(warning)
    _server("serving").serve(app, host=host, port=port)
    return DONE


def _check(settings: Any) -> int:
    """Say what a start would do, once address, settings and tokens are known to be usable."""
    _server("http.access").read_tokens(settings.tokens)
    records = _server("records.service")
    try:
        found = records.records_outlook(
            records=settings.records, database_url=settings.database_url, data=settings.data
        )
    except _server("records.entries").Unavailable as error:
        say(f"It starts, and cannot record: {error}")
        return FAILED
    write(f"It can start. {found}\n")
    return DONE


def open_to_all(host: str, tokens: str, open_control: str = "off") -> str:
    """What to say of a service that others may ask without tokens; empty if they may not.

    Args:
        host: the address that it listens at.
        tokens: the setting.
        open_control: the setting.
    """
    if tokens or _is_loopback(host):
        return ""
    may = "start flights, and command and end their own"
    if open_control == "on":
        may = "start, command and end all flights, and delete records"
    return f"Everyone that reaches {host} may {may}: set RELGUIDE_TOKENS to say who may do what."


def _is_loopback(host: str) -> bool:
    found: bool = _server("http.access").is_loopback(host)
    return found


def _server(name: str) -> Any:
    """A module of the service, by name: the library knows nothing of what stands on it."""
    return import_module(f"relguide_server.{name}")


def _port(text: str) -> int:
    if not (text.isascii() and text.isdigit() and 0 < int(text[:12]) < 2**16):
        raise argparse.ArgumentTypeError(f"must be a whole number from 1 to 65535, not {text}")
    return int(text)
