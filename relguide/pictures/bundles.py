"""Where the programs and the type are that `web/build_page.py` makes for use outside the page."""

from pathlib import Path

PACKAGE = Path(__file__).parents[2]
FOLDERS = (PACKAGE / "relguide_server" / "page" / "embed", PACKAGE / "web" / "dist" / "embed")
"""Beside the page: in the wheel when installed, in the source tree otherwise."""


def bundle(name: str) -> Path:
    """One of those files.

    Raises:
        ValueError: if they were not built, in a sentence.
    """
    for folder in FOLDERS:
        if (folder / name).is_file():
            return folder / name
    raise ValueError(
        f"{name} is missing: this relguide was installed without its page. In the source tree "
        "`python web/build_page.py` makes it."
    )
