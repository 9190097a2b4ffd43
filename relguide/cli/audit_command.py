"""`relguide audit`: how good a network is, against exact answers."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from relguide.cli.output import DONE, add_form, for_people, write_json
from relguide.cli.shared_options import add_workers, count
from relguide.planning.extras import need

if TYPE_CHECKING:
    from relguide.learn.audits.side_by_side import Ground, MethodResult
    from relguide.learn.words.branch_network import BranchNetwork

PURPOSE = "say how good a network is, against exact answers"
EXAMPLES = """
    relguide audit                               of the weights that come with the program
    relguide audit weights.safetensors --json    of your own; the figures as JSON
    relguide audit --count 1000000 --seed 2
    relguide audit --method templates            of the network for where d_min binds
    relguide audit --figures docs/figures        its pictures
    relguide audit --count 100000000 --dask tcp://host:8786     on many machines
    """
METHODS = ("branches", "templates")
"""What the network has learnt."""
BRANCHES, TEMPLATES, BESIDE = 100_000, 20_000, 20_000
"""How many situations an audit looks at: half a minute, and one to two."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide audit`."""
    parser.add_argument(
        "weights",
        metavar="WEIGHTS.safetensors",
        type=Path,
        nargs="?",
        help="left out: the weights that come with the program",
    )
    parser.add_argument(
        "--method",
        choices=METHODS,
        default=METHODS[0],
        help="what it has learnt; default: %(default)s",
    )
    parser.add_argument(
        "--count",
        metavar="N",
        type=count,
        help="fresh situations to judge it in; default: "
        f"{BRANCHES}; templates: {TEMPLATES}, and as many in which d_min may bind or not",
    )
    parser.add_argument(
        "--seed",
        metavar="N",
        type=count,
        default=1,
        help="of these situations, another than the training's; default: %(default)s",
    )
    parser.add_argument(
        "--beside",
        metavar="N",
        type=count,
        help="branches: situations to judge it in beside the paper's network, the nearest path "
        f"of its tree and direct regression; default: {BESIDE}",
    )
    parser.add_argument(
        "--figures", metavar="FOLDER", type=Path, help="draw what is found, as .svg"
    )
    add_workers(parser)
    add_form(parser)


def run(chosen: argparse.Namespace) -> int:
    """Audit the network, draw and print what is found."""
    need("torch", "rich", extra="learn")
    if chosen.method == "templates" and chosen.beside is not None:
        raise ValueError(
            "Nothing else is known to learn templates: --beside is for --method branches."
        )
    if chosen.figures is not None:
        from relguide.figures.area_figure import check_figure

        chosen.figures.mkdir(parents=True, exist_ok=True)
        check_figure(chosen.figures / "audit.svg")
    if chosen.method == "templates":
        _audit_templates(chosen)
    else:
        _audit_branches(chosen)
    return DONE


def _audit_branches(chosen: argparse.Namespace) -> None:
    from relguide.cli.branch_tables import print_audit
    from relguide.cli.workers import collect, start_workers
    from relguide.learn.audits.branch_audit import audit_as_json, audit_of
    from relguide.learn.audits.branch_judging import branch_audit_request, judge_chunks, latencies
    from relguide.learn.audits.latency import latency_as_json
    from relguide.learn.audits.side_by_side import method_as_json
    from relguide.learn.words.branch_network import load_network
    from relguide.planning.progress import progress_bar

    network = load_network() if chosen.weights is None else load_network(chosen.weights)
    size = BRANCHES if chosen.count is None else chosen.count
    beside = BESIDE if chosen.beside is None else chosen.beside
    request = branch_audit_request(network, size, chosen.seed)
    with start_workers(chosen.threads, chosen.dask) as pool:
        chunks = collect(judge_chunks(network, request, pool), "auditing", request.chunks)
    with progress_bar("explaining gaps", total=0.0) as advance:
        audit = audit_of(chunks, advance)
    asked = latencies(network, request)
    ground, methods = _judge_side_by_side(network, beside, chosen.seed) if beside else (None, [])
    if chosen.figures is not None:
        from relguide.figures.branch_figure import draw_audit

        draw_audit(audit, methods, network.least_share, chosen.figures)
    if for_people(chosen):
        print_audit(audit, asked, ground, methods)
        return
    about = {
        "situations": size,
        "seed": chosen.seed,
        "least_share": network.least_share,
        "network": network.about,
    }
    found: dict[str, Any] = about | audit_as_json(audit) | {"latency": latency_as_json(asked)}
    if ground is not None:
        found["side_by_side"] = {
            "situations": len(ground),
            "left_out_the_limit_binds": ground.binding,
            "methods": {method.name: method_as_json(method) for method in methods},
        }
    write_json(found)


def _judge_side_by_side(
    network: "BranchNetwork", size: int, seed: int
) -> "tuple[Ground, list[MethodResult]]":
    """Draw common situations, grow the paper's tree, and judge all methods there."""
    from relguide.cli.tree_growth import grow_tree
    from relguide.learn.audits.side_by_side import draw_ground, side_by_side
    from relguide.learn.tree.nearest import lookup_in
    from relguide.learn.tree.regular_network import load_regular, shipped_weights
    from relguide.planning.progress import progress_bar, show_progress

    regressions = [load_regular(shipped_weights(method)) for method in ("paper", "direct")]
    parameters = regressions[0].parameters
    with progress_bar("drawing situations", total=size) as advance:
        ground = draw_ground(parameters, size, seed, advance)
    lookup = lookup_in(grow_tree(parameters))
    found = show_progress(
        enumerate(side_by_side(ground, network, lookup, regressions), start=1),
        title="side by side",
        total=2 + len(regressions),
        done=lambda item: item[0],
    )
    return ground, [method for _, method in found]


def _audit_templates(chosen: argparse.Namespace) -> None:
    from relguide.cli.template_tables import print_template_audit
    from relguide.cli.workers import collect, start_workers
    from relguide.learn.audits.constrained_judging import template_latencies
    from relguide.learn.audits.latency import latency_as_json
    from relguide.learn.audits.planner_judging import UNIT
    from relguide.learn.audits.template_audit import template_audit_as_json, template_audit_of
    from relguide.learn.audits.template_judging import (
        join_template_verdicts,
        judge_template_chunks,
        template_audit_request,
    )
    from relguide.learn.boundary.template_network import load_template_network
    from relguide.learn.words.branch_network import load_network

    weights = chosen.weights
    templates = load_template_network() if weights is None else load_template_network(weights)
    branches = load_network()
    size = TEMPLATES if chosen.count is None else chosen.count
    request = template_audit_request(templates, size, chosen.seed)
    with start_workers(chosen.threads, chosen.dask) as pool:
        judging = judge_template_chunks(templates, branches, request, pool)
        chunks = collect(judging, "auditing", request.chunks)
    audit = template_audit_of(chunks)
    asked = template_latencies(templates, join_template_verdicts(chunks).bound.situations)
    if chosen.figures is not None:
        from relguide.figures.template_figure import draw_template_audit

        draw_template_audit(audit, chosen.figures)
    if for_people(chosen):
        print_template_audit(audit, asked)
        return
    about = {
        "situations": size,
        "seed": chosen.seed,
        "least_share": templates.least_share,
        "most": templates.most,
        "doubt": templates.doubt,
        "r_per_v_s": UNIT,
        "network": templates.about,
    }
    write_json(about | template_audit_as_json(audit) | {"latency": latency_as_json(asked)})
