"""A Markdown extension for the guide: links to files that the guide does not hold become text.

Pages of docs/ link to files of the repository, such as `../examples/settings.toml`. In a clone the
link leads there; on the guide's site, which holds docs/ alone, its words remain.
"""

import re
from pathlib import Path
from xml.etree.ElementTree import Element

from markdown import Markdown
from markdown.extensions import Extension
from markdown.treeprocessors import Treeprocessor

DOCS = Path(__file__).parents[1] / "docs"


class _Unlink(Treeprocessor):
    def run(self, root: Element) -> None:
        for link in root.iter("a"):
            climbs, path = re.fullmatch(r"((?:\.\./)*)([^#?]*).*", link.get("href", "")).groups()  # type: ignore[union-attr]
            if climbs and path and not (DOCS / path).exists():
                link.tag = "span"
                del link.attrib["href"]


class GuideLinks(Extension):
    """Links that leave docs/ become text."""

    def extendMarkdown(self, md: Markdown) -> None:
        """Add the processor that does it, behind the one that makes links."""
        md.treeprocessors.register(_Unlink(md), "guide_links", 5)


def makeExtension(**configs: object) -> GuideLinks:
    """The extension, as Markdown asks for it by the name of this module."""
    return GuideLinks(**configs)
