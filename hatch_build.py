"""Builds the cockpit's page whenever pip builds or installs relguide (`web/build_page.py`).

An installed wheel carries the page as `relguide_server/page`; an editable install reads `web/dist`
from the tree. `RELGUIDE_SKIP_WEB=1` leaves the page out. `RELGUIDE_KERNELS=FOLDER` adds the kernels
that `python -m relguide.warm_up` has kept there: such a wheel is for one Python and platform, see
`make wheel`. `RELGUIDE_GUIDE=FOLDER` adds the guide that `make guide` has built there, as
`relguide_server/guide`.
"""

import os
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

sys.path.insert(0, str(Path(__file__).resolve().parent / "web"))
from build_page import build_page


class WebPageHook(BuildHookInterface[Any]):
    """hatchling's custom hook: builds the page and puts it into the wheel."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the page, and collect kernels and guide, before the wheel is put together."""
        kernels = os.environ.get("RELGUIDE_KERNELS")
        if kernels and version == "standard":
            self._add_kernels(Path(kernels), build_data)
        guide = os.environ.get("RELGUIDE_GUIDE")
        if guide and version == "standard":
            self._add_guide(Path(self.root) / guide, build_data)
        if os.environ.get("RELGUIDE_SKIP_WEB") == "1":
            self.app.display_warning("RELGUIDE_SKIP_WEB=1: the web page is left out.")
            return
        page = build_page(Path(self.root))
        if version == "standard":
            build_data["force_include"][str(page)] = "relguide_server/page"

    def _add_kernels(self, folder: Path, build_data: dict[str, Any]) -> None:
        if not (folder / "everything.warm").is_file():
            sys.exit(f"{folder} does not hold all kernels: python -m relguide.warm_up fills it.")
        for file in folder.iterdir():
            if file.suffix in (".nbi", ".nbc", ".warm"):
                build_data["force_include"][str(file)] = f"relguide/kernels/compiled/{file.name}"
        build_data["pure_python"] = False
        build_data["infer_tag"] = True

    def _add_guide(self, folder: Path, build_data: dict[str, Any]) -> None:
        if not (folder / "index.html").is_file():
            sys.exit(f"{folder} holds no guide: make guide builds it into build/guide.")
        build_data["force_include"][str(folder)] = "relguide_server/guide"
