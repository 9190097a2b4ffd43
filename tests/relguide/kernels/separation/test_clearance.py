"""The pieces of a leader's intent follow each other without a gap."""

from math import inf, nextafter

import numpy as np
import pytest

from relguide.kernels.separation.clearance import piece_at, piece_end

BEGINS = [0.0, 0.5, 2.25, 7.0]


@pytest.mark.parametrize("pieces", [1, 2, 4])
def test_a_piece_ends_where_the_next_begins(pieces: int) -> None:
    leader = np.zeros((pieces, 5))
    leader[:, 0] = BEGINS[:pieces]
    for i in range(pieces - 1):
        end = piece_end(leader, i)
        assert piece_at(leader, nextafter(end, 0.0)) == i
        assert piece_at(leader, end) == i + 1
    assert piece_end(leader, pieces - 1) == inf
