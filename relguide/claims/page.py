"""docs/claims.md: every claim, what measures it, and what was obtained last."""

from collections.abc import Mapping, Sequence
from math import floor, log10

from relguide.claims.claim import Claim
from relguide.claims.run import total_minutes
from relguide.claims.uncovered import Uncovered, all_uncovered

HEAD = """# Which numbers are claimed, and do they hold?

`relguide claims --page docs/claims.md` makes this page. A row is a number that README or docs tell;
[the last table](#told-not-checked) has the numbers that no command checks.

```sh
relguide claims --quick    # {quick} claims, within five minutes on two cores
relguide claims --all      # {every} claims: {all_minutes} min; and {kept} that are kept
relguide claims NAME       # some of them
```

The command prints what each claim expects and what it obtains. It ends with 1 if a number is out of
its tolerance, or if nothing was run at all. A claim that lacks a package is not run, and does not
count. A command that fails does not end the run. `--all` overwrites tables and pages of this clone,
because some of its commands write them. With `--page docs/claims.md` each number is kept as soon as
its command has ended, so a run that is stopped loses none.

*Obtained* is of the last run that was kept here. *Not run* means that its own command measured the
number when the page was written, and that `relguide claims` has not run it again since, nor for
this release. Some claims come from campaigns of hours or from another machine's load: their tables
are kept in `benchmarks/results`, and `--all` compares each with its table and measures nothing.
"""
UNCHECKED = """
## Told, not checked

| told in | words | why no command checks them |
|---|---|---|
"""
TITLES = {
    "quick": "Checked by `--quick`",
    "all": "Checked by `--all`",
    "kept": "Kept: measured by a campaign",
}


def claims_page(claims: Sequence[Claim], obtained: Mapping[str, float]) -> str:
    """The page.

    Args:
        claims: all of them.
        obtained: what those have that were ever run, by their names.
    """
    of = {when: [claim for claim in claims if claim.runs == when] for when in TITLES}
    running = [*of["quick"], *of["all"]]
    written = HEAD.format(
        quick=len(of["quick"]),
        every=len(running),
        all_minutes=round(total_minutes(running)),
        kept=len(of["kept"]),
    )
    for when, title in TITLES.items():
        written += f"\n## {title}\n"
        for command in dict.fromkeys(claim.command for claim in of[when]):
            rows = [claim for claim in of[when] if claim.command == command]
            written += _section(command, rows, obtained)
    return written + UNCHECKED + "".join(map(_unchecked, all_uncovered()))


def number(value: float, like: Claim) -> str:
    """A number with as many decimals as its claim has."""
    told = (like.expected, like.tolerance or 0.0, like.at_most or 0.0, like.at_least or 0.0)
    decimals = max(len(f"{one:.10g}".partition(".")[2]) for one in told)
    if value and not round(value, decimals):
        decimals = 1 - floor(log10(abs(value)))
    return f"{value:,.{decimals}f}"


def expected(claim: Claim) -> str:
    """What a claim expects, with its tolerance or bound."""
    unit = f" {claim.unit}" if claim.unit else ""
    if claim.at_most is not None:
        return f"{number(claim.expected, claim)} (≤ {number(claim.at_most, claim)}){unit}"
    if claim.at_least is not None:
        return f"{number(claim.expected, claim)} (≥ {number(claim.at_least, claim)}){unit}"
    off = f" ± {claim.tolerance:g}" if claim.tolerance else ""
    return f"{number(claim.expected, claim)}{off}{unit}"


def _section(command: str, rows: Sequence[Claim], obtained: Mapping[str, float]) -> str:
    takes = rows[0].minutes
    time = f"{takes:.0f} min" if takes >= 1.0 else f"{60.0 * takes:.0f} s"
    hours = f"{takes / 60.0:.1f} h" if takes >= 90.0 else time
    lines = [
        f"\n`{command}`, {hours}:\n",
        "| claim | expected | obtained | said in | held by |",
        "|---|---:|---:|---|---|",
    ]
    for claim in rows:
        have = obtained.get(claim.name)
        got = "not run" if have is None else number(have, claim)
        file, _, test = claim.test.partition("::")
        lines.append(
            f"| {claim.name}: {claim.sentence} | {expected(claim)} | {got} "
            f"| {_link(claim.page)} | [{test}](../{file}) |"
        )
    return "\n".join(lines) + "\n"


def _unchecked(rows: Uncovered) -> str:
    if not rows.measured:
        return ""
    return "".join(
        f"| {_link(page)} | {'; '.join(words)} | {rows.reason} |\n"
        for page, words in rows.words.items()
    )


def _link(page: str) -> str:
    folder, _, title = page.rpartition("/")
    if not folder:
        return f"`{title}`"  # the guide holds docs/ alone
    return f"[{title}]({page.removeprefix('docs/')})"
