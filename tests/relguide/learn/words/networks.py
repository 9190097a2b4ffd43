"""A small network, trained in seconds, that the tests share."""

import argparse
from functools import cache

from relguide.learn.training.options import TrainingOptions, add_options
from relguide.learn.words.branch_labels import Box, LabelRequest, Labels, join_labels, label_chunk
from relguide.learn.words.branch_network import BranchNetwork, NetworkShape
from relguide.learn.words.train_branches import train

REQUEST = LabelRequest(count=12_000, seed=5, chunk=4000)
OPTIONS = TrainingOptions(
    shape=NetworkShape(width=24, depth=2), epochs=10, batch=256, threads=1, device="cpu"
)


@cache
def labels() -> Labels:
    return join_labels({number: label_chunk(REQUEST, number) for number in range(REQUEST.chunks)})


@cache
def network() -> BranchNetwork:
    """Trained from scratch; right in more than four of five labels it has not seen."""
    *_, last = train(labels(), OPTIONS, box=Box(), about={"dataset": {"seed": REQUEST.seed}})
    return last.network


def options(*arguments: str) -> argparse.Namespace:
    """Options as the command line gives them."""
    parser = argparse.ArgumentParser()
    add_options(parser)
    return parser.parse_args(arguments)
