"""Labels behind leaders who turn, and the network that comes with the program, for the tests."""

from functools import cache

from relguide.learn.boundary.template_labels import TemplateLabels, join_labels
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.learn.boundary.turn_labels import TurnBox, TurnLabelRequest
from relguide.learn.boundary.turn_network import load_turn_network

REQUEST = TurnLabelRequest(count=400, seed=5, chunk=200)


@cache
def labels() -> TemplateLabels:
    return join_labels({number: REQUEST.make(number) for number in range(REQUEST.chunks)})


@cache
def turns() -> TemplateNetwork[TurnBox]:
    return load_turn_network()
