"""Packages that only some tasks need, and the extra of `pip install` that brings each.

The library itself needs numpy, numba and pydantic. Where a task needs more and it is missing, a
sentence gives the command.
"""

from importlib.util import find_spec

EXTRAS = {
    "alembic": "serve",
    "contourpy": "serve",
    "fastapi": "serve",
    "fastapi_swagger": "serve",
    "orjson": "serve",
    "prometheus_client": "serve",
    "pydantic_settings": "serve",
    "pyproj": "serve",
    "platformdirs": "serve",
    "rich": "serve",
    "sqlalchemy": "serve",
    "uvicorn": "serve",
    "viser": "serve",
    "websockets": "serve",
    "httpx2": "client",
    "torch": "learn",
    "matplotlib": "figures",
    "quickjs": "pictures",
    "resvg_py": "pictures",
    "anywidget": "notebook",
    "distributed": "cluster",
    "pyarrow": "parquet",
    "psycopg": "postgres",
    "asterix": "atc",
    "cfgrib": "winds",
    "eccodes": "winds",
    "xarray": "winds",
}
"""A package, as it is imported, and the smallest extra that brings it."""


class MissingExtra(ModuleNotFoundError):
    """A task needs a package that is not installed; its sentence gives the command."""

    def __init__(self, package: str, extra: str) -> None:
        super().__init__(
            f"This needs the package {package}, which is not installed: "
            f"pip install 'relguide[{extra}]' brings it.",
            name=package,
        )


def need(*packages: str, extra: str = "") -> None:
    """Refuse to begin what could not be finished.

    Args:
        packages: what is about to be imported, by the names of `EXTRAS`.
        extra: the extra to install, where a task needs more of it than these packages; otherwise
            the smallest that brings the missing one.

    Raises:
        MissingExtra: naming the first package that is not installed.
    """
    for package in packages:
        if not is_installed(package):
            raise MissingExtra(package, extra or EXTRAS[package])


def add_command(error: ModuleNotFoundError) -> ModuleNotFoundError:
    """The same error with the command that brings the package, if an extra does."""
    package = (error.name or "").partition(".")[0]
    if isinstance(error, MissingExtra) or package not in EXTRAS:
        return error
    return MissingExtra(package, EXTRAS[package])


def is_installed(package: str) -> bool:
    """Whether a package can be imported."""
    try:
        return find_spec(package) is not None
    except ModuleNotFoundError:
        return False
