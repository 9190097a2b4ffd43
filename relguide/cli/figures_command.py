"""`relguide figures`: the paper's figures and ours, drawn anew, as files or as a gallery."""

import argparse
import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from relguide.cli.output import DONE, add_form, for_people, say, write, write_json
from relguide.planning.extras import need
from relguide.planning.progress import progress_bar

if TYPE_CHECKING:
    from relguide.figures.drawn import Drawn, NamedFigure

PURPOSE = "draw the paper's figures, and what was measured beyond them"
EXAMPLES = """
    relguide figures --list                        which there are, and what each takes
    relguide figures --out figures                 all of them as SVG
    relguide figures fig_6a fig_6b --out figures --format both
    relguide figures --gallery docs/gallery.md     all, and a page that shows them
    """
FORMATS = {"svg": ("svg",), "png": ("png",), "both": ("svg", "png")}


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide figures`."""
    parser.add_argument(
        "names", metavar="NAME", nargs="*", help="figures, as --list names them; default: all"
    )
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--out", metavar="DIR", type=Path, default=Path("figures"), help="default: figures"
    )
    where.add_argument(
        "--gallery",
        metavar="FILE.md",
        type=Path,
        help="a page that shows them, with SVG in figures/gallery beside it",
    )
    where.add_argument("--list", action="store_true", help="only name them")
    parser.add_argument("--format", choices=tuple(FORMATS), default="svg", help="default: svg")
    add_form(parser)


def run(chosen: argparse.Namespace) -> int:
    """Draw them, or list them."""
    from relguide.figures.catalogue import figures_of

    figures = figures_of(chosen.names)
    if chosen.list:
        return _list(figures, table=for_people(chosen))
    if chosen.gallery is not None and chosen.names:
        raise ValueError("A gallery shows all figures: leave the names out.")
    if chosen.gallery is not None and chosen.format != "svg":
        raise ValueError("A gallery is of SVG: leave --format out.")
    formats = FORMATS[chosen.format]
    need(*{package for figure in figures for package in figure.needs})
    if "png" in formats and any("quickjs" in figure.needs for figure in figures):
        need("resvg_py")
    folder = chosen.out if chosen.gallery is None else chosen.gallery.parent / _gallery_folder()
    folder.mkdir(parents=True, exist_ok=True)
    captions = []
    for figure, drawn in _drawn(figures):
        for suffix in formats:
            (folder / f"{figure.name}.{suffix}").write_bytes(_bytes(drawn, suffix))
        captions.append((figure, drawn.caption))
    if chosen.gallery is not None:
        from relguide.figures.gallery import page_of

        chosen.gallery.write_text(page_of(captions), encoding="utf-8")
    if for_people(chosen):
        write("".join(f"{folder / figure.name}: {caption}\n" for figure, caption in captions))
    else:
        write_json(
            {
                "figures": [
                    {
                        "name": figure.name,
                        "files": [str(folder / f"{figure.name}.{suffix}") for suffix in formats],
                        "caption": caption,
                        "command": figure.command,
                    }
                    for figure, caption in captions
                ]
            }
        )
    told = "1 figure is" if len(captions) == 1 else f"{len(captions)} figures are"
    say(f"{told} in {folder}{os.sep}.")
    return DONE


def _drawn(figures: "list[NamedFigure]") -> "Iterator[tuple[NamedFigure, Drawn]]":
    """Each with what was drawn; the bar counts seconds of work, as they were measured."""
    from relguide.figures.drawn import draw

    with progress_bar("drawing", total=sum(figure.seconds for figure in figures)) as count:
        for figure in figures:
            reached = 0.0

            def step(share: float, seconds: float = figure.seconds) -> None:
                nonlocal reached
                reached += share
                count(share * seconds)

            drawn = draw(figure, step)
            yield figure, drawn
            count(max(1.0 - reached, 0.0) * figure.seconds)


def _bytes(drawn: "Drawn", suffix: str) -> bytes:
    from relguide.figures.drawn import as_png, as_svg

    return as_png(drawn) if suffix == "png" else as_svg(drawn)


def _gallery_folder() -> Path:
    from relguide.figures.gallery import FOLDER

    return FOLDER


def _list(figures: "list[NamedFigure]", *, table: bool) -> int:
    """Name, title and seconds of each."""
    if table:
        widest = max(len(figure.name) for figure in figures)
        write(
            "".join(
                f"{figure.name:<{widest}}  {figure.seconds:>4.0f} s  {figure.title}\n"
                for figure in figures
            )
        )
        total = sum(figure.seconds for figure in figures)
        write(f"{'all':<{widest}}  {total:>4.0f} s  of one processor, about\n")
    else:
        write_json(
            {
                "figures": [
                    {"name": figure.name, "title": figure.title, "cpu_s": figure.seconds}
                    for figure in figures
                ]
            }
        )
    return DONE
