"""Labels where the limit binds and a small network of them, trained in seconds, for the tests."""

from functools import cache

from relguide.learn.boundary.template_labels import (
    TemplateBox,
    TemplateLabelRequest,
    TemplateLabels,
    join_labels,
    template_label_chunk,
)
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.learn.boundary.train_templates import train_templates
from relguide.learn.training.options import NetworkShape, TrainingOptions

REQUEST = TemplateLabelRequest(count=1500, seed=5, chunk=500)
OPTIONS = TrainingOptions(
    shape=NetworkShape(width=48, depth=2), epochs=25, batch=64, threads=1, device="cpu"
)


@cache
def labels() -> TemplateLabels:
    return join_labels(
        {number: template_label_chunk(REQUEST, number) for number in range(REQUEST.chunks)}
    )


@cache
def ways() -> TemplateNetwork:
    """Trained from scratch; right in more than half of the labels it has not seen."""
    *_, last = train_templates(labels(), OPTIONS, box=TemplateBox(), about={"seed": REQUEST.seed})
    return last.network
