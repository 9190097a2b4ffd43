"""Anything at all, to be given where something else is expected."""

from decimal import Decimal
from fractions import Fraction
from math import inf, nan

import numpy as np
from hypothesis import strategies as st

from relguide import (
    NoPlan,
    Reason,
)
from tests.calls import LEADER, PATH, PLAN, PURSUER, SITUATION

junk = st.one_of(
    st.none(),
    st.booleans(),
    st.text(max_size=3),
    st.binary(max_size=3),
    st.integers(),
    st.floats(),
    st.complex_numbers(),
    st.fractions(),
    st.decimals(),
    st.lists(st.floats(), max_size=3),
    st.tuples(st.floats()),
    st.dictionaries(st.text(max_size=2), st.floats(), max_size=2),
    st.sampled_from(
        [
            nan,
            inf,
            -inf,
            10**400,
            np.True_,
            np.float64(nan),
            np.float32(inf),
            np.int64(-3),
            np.array(1.0),
            np.array([1.0, nan]),
            np.array(["a"]),
            np.datetime64("2003-08-11"),
            Decimal("NaN"),
            Fraction(-1, 3),
            object(),
            ((1.0,), 2.0),
            [[1.0], [1.0, 2.0]],
            PURSUER,
            LEADER,
            SITUATION,
            PATH,
            PLAN,
            NoPlan(reason=Reason.SLOT_UNREACHABLE, message="None."),
        ]
    ),
)
