"""`relguide claims`: the numbers of README and docs, measured again and held against."""

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from relguide.cli.output import DONE, FAILED, add_form, for_people, say, write, write_json
from relguide.planning.progress import show_progress

if TYPE_CHECKING:
    from relguide.claims.claim import Claim
    from relguide.claims.run import Checked, Running

PURPOSE = "measure again what README and docs claim, and compare"
EXAMPLES = """
    relguide claims --quick                        what two cores measure within five minutes
    relguide claims --all                          all; campaigns are read from kept tables
    relguide claims fig-6a-joins fig-6b-joins      some of them; docs/claims.md names all
    relguide claims --quick --page docs/claims.md  and write that page anew

    A claim that lacks a package or a clone is not run. The exit status is 1 if a number
    is out of its tolerance, or if nothing was run at all.
    """


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide claims`."""
    parser.add_argument("names", nargs="*", metavar="NAME", help="claims to check")
    which = parser.add_mutually_exclusive_group()
    which.add_argument(
        "--quick", action="store_true", help="those that two cores measure within five minutes"
    )
    which.add_argument(
        "--all",
        action="store_true",
        help="all; campaigns are read from kept tables, other tables and pages are overwritten",
    )
    parser.add_argument(
        "--page", metavar="FILE", type=Path, help="keep what is obtained, and write the page of it"
    )
    add_form(parser)


def run(chosen: argparse.Namespace) -> int:
    """Check claims, or write their page."""
    people = for_people(chosen, "rich")
    from relguide.claims.claim import all_claims, named_claims
    from relguide.claims.kept import clone, keep_obtained, read_obtained
    from relguide.claims.page import claims_page

    if chosen.names and (chosen.quick or chosen.all):
        raise ValueError("Give names, or --quick, or --all.")
    if not (chosen.names or chosen.quick or chosen.all or chosen.page):
        raise ValueError("Say which claims to check: --quick, --all, or their names.")
    claims = all_claims()
    wanted = (
        claims
        if chosen.all
        else tuple(claim for claim in claims if claim.runs == "quick")
        if chosen.quick
        else named_claims(chosen.names)
    )
    root = clone()
    if chosen.page is not None and root is None:
        raise ValueError("The page needs the tables of benchmarks/results: a clone has them.")
    if chosen.page is not None and not chosen.page.parent.is_dir():
        raise ValueError(f"There is no folder {chosen.page.parent} for the page: make it first.")
    checked: tuple[Checked, ...] = ()
    try:
        for checked in _check(wanted, root):
            if chosen.page is not None and root is not None:
                new = {one.claim.name: one.obtained for one in checked if one.obtained is not None}
                keep_obtained(claims, new, root)
    except KeyboardInterrupt:
        _show(checked, people)
        kept = " What they obtained is kept." if chosen.page is not None else ""
        say(f"{len(checked)} of {len(wanted)} claims were checked.{kept}")
        raise
    if wanted:
        _show(checked, people)
    if chosen.page is not None and root is not None:
        chosen.page.write_text(claims_page(claims, read_obtained(claims, root)), encoding="utf-8")
        say(f"Written: {chosen.page}.")
    return _conclude(checked) if wanted else DONE


def _check(wanted: "tuple[Claim, ...]", root: Path | None) -> "Iterator[tuple[Checked, ...]]":
    """Yields what is known whenever that is more, and at last all in the order of the file."""
    from relguide.claims.run import check_claims, total_minutes

    def state(now: "Running") -> str:
        words = now.command.removeprefix("python -m ").split()
        name = " ".join(words[: 2 if words[:1] == ["relguide"] else 1])
        return f"{len(now.checked)} of {len(wanted)}, {name} {now.seconds:.0f} s"

    known = 0
    for now in show_progress(
        check_claims(wanted, root),
        title="checking",
        total=total_minutes(wanted),
        done=lambda now: now.minutes,
        state=state,
    ):
        if len(now.checked) > known or not now.command:
            known = len(now.checked)
            yield now.checked


def _show(checked: "tuple[Checked, ...]", people: bool) -> None:
    if people:
        _print(checked)
    else:
        write_json({"claims": [_as_json(one) for one in checked]})


def _print(checked: "tuple[Checked, ...]") -> None:
    from relguide.claims.page import expected, number
    from relguide.cli.shared_tables import print_table, table

    shown = table("claim")
    for heading in ("expected", "obtained", "ok"):
        shown.add_column(heading, justify="right", no_wrap=True)
    for one in checked:
        got = "–" if one.obtained is None else number(one.obtained, one.claim)
        shown.add_row(one.claim.name, expected(one.claim), got, _verdict(one))
    print_table(shown)
    for one in checked:
        if one.why:
            write(f"{one.claim.name}: {one.why}\n")


def _conclude(checked: "tuple[Checked, ...]") -> int:
    """Say what became of them; the exit status."""
    failed = [one.claim.name for one in checked if one.failed]
    left = sum(not one.ran for one in checked)
    measured = sum(one.ok and one.measured for one in checked)
    compared = sum(one.ok and not one.measured for one in checked)
    if left:
        say(f"{left} of {len(checked)} claims were not run; the exit status leaves them out.")
    if failed:
        say(f"{len(failed)} of {len(checked)} claims do not hold: {', '.join(failed)}.")
        return FAILED
    if not measured + compared:
        return FAILED
    say(f"{measured} measured and {compared} compared with their tables hold.")
    return DONE


def _verdict(one: "Checked") -> str:
    if not one.ran:
        return "not run"
    holds = "yes" if one.measured else "kept"
    return holds if one.ok else "NO"


def _as_json(one: "Checked") -> dict[str, object]:
    claim = one.claim
    return {
        "name": claim.name,
        "sentence": claim.sentence,
        "page": claim.page,
        "command": claim.command,
        "expected": claim.expected,
        "tolerance": claim.tolerance,
        "at_most": claim.at_most,
        "at_least": claim.at_least,
        "unit": claim.unit,
        "obtained": one.obtained,
        "measured": one.measured,
        "ok": one.ok if one.ran else None,
        "why": one.why,
        "test": claim.test,
        "runs": claim.runs,
    }
