"""Which words count, by what is known of the set to which they lead."""

import numpy as np

from benchmarks import proofs
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.contact_bound import cell_bound
from relguide.kernels.bounds.rest import no_rest
from relguide.planning.prove import question_of
from relguide.planning.words import candidates


def test_of_three_turns_that_are_not_two_the_middle_one_is_the_longest() -> None:
    """By three turns, the first of them hardly any, the last would be longer, and end at once."""
    rng = np.random.default_rng([205, 3, 118])
    question = question_of(candidates(proofs.draw(proofs.KINDS[3], rng, 118)))
    start, scene, goal = question.start, question.scene, question.goal
    cell = Cell(1, 1.0, 0.51197, 3.8e-4, 0.96904, 0.97181)
    for switch, least, most in ((True, 0.0, 0.01), (False, 1.5, 1.7)):
        passed, _, _ = cell_bound(
            start, scene, goal, cell, 10.0, True, switch, no_rest(), no_rest()
        )  # fmt: skip
        assert least <= passed.turned - passed.outward <= most
