"""`relguide serve`: the service and the cockpit."""

import argparse
import os
import socket
from importlib import import_module

from relguide.cli.output import DONE, write
from relguide.planning.extras import need

PURPOSE = "start the service and the cockpit"
EXAMPLES = """
    relguide serve                            on http://127.0.0.1:8000
    relguide serve --host 0.0.0.0 --port 80   for other machines too
    """


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide serve`."""
    parser.add_argument("--host", default="127.0.0.1", help="default: %(default)s")
    parser.add_argument("--port", type=_port, default=8000, help="default: %(default)s")
    parser.add_argument(
        "--workers",
        type=int,
        metavar="N",
        help="processes for what takes longer than a millisecond (default: one a core, 2 to 4)",
    )


def run(chosen: argparse.Namespace) -> int:
    """Serve until stopped; an address that cannot be used is an OSError."""
    need("fastapi", "uvicorn", "viser", "orjson", "msgspec", "websockets", "sqlalchemy", "alembic")
    host, port = chosen.host, chosen.port
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family) as probe:  # uvicorn would say it in a log line, and exit
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError as error:
            raise OSError(error.errno, error.strerror, f"{host}, port {port}") from None
    if chosen.workers is not None:
        os.environ["RELGUIDE_WORKERS"] = str(chosen.workers)
    # By name: the library knows nothing of the service that stands on it; its command starts it.
    serving, app = (
        import_module("relguide_server.serving"),
        import_module("relguide_server.app").app,
    )
    shown = f"[{host}]" if ":" in host else host
    write(f"relguide is on http://{shown}:{port} (Ctrl-C stops it)\n")
    serving.serve(app, host=host, port=port)
    return DONE


def _port(text: str) -> int:
    if not (text.isascii() and text.isdigit() and 0 < int(text[:12]) < 2**16):
        raise argparse.ArgumentTypeError(f"must be a whole number from 1 to 65535, not {text}")
    return int(text)
