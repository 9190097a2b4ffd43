"""The longest believable chain of a recording is one that a moving thing can have made."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from relguide.flying.smoothing import MAX_GAP, longest_chain

RATE, SLACK = 200.0, 100.0


@given(
    wrong=st.sets(st.integers(0, 99), max_size=30),
    by=st.floats(1000.0, 1e6),
)
@settings(max_examples=30)
def test_the_longest_believable_chain_has_no_jump(wrong: set[int], by: float) -> None:
    t = np.arange(100.0)
    values = np.column_stack([100.0 * t, np.zeros(100)])
    for n in wrong:
        values[n, 1] = by * (1 + n % 3)
    chain = longest_chain(t, values, 200.0, 100.0)
    steps = np.hypot(*np.diff(values[chain], axis=0).T)
    assert np.all(steps <= 200.0 * np.diff(t[chain]) + 100.0)
    assert np.all(np.diff(t[chain]) <= 30.0)
    assert len(chain) >= (100 - len(wrong)) // 2


def chain_by_trying_all(t: np.ndarray, values: np.ndarray) -> list[int]:
    """The same, where each point is held against all before it: of the longest the latest."""
    longest, before = [1] * len(t), [-1] * len(t)
    for i in range(len(t)):
        for k in range(i):
            elapsed = t[i] - t[k]
            jump = np.sqrt(np.sum((values[k] - values[i]) ** 2))
            if 0.0 < elapsed <= MAX_GAP and jump <= RATE * elapsed + SLACK:
                if longest[k] + 1 >= max(longest[i], 2):
                    longest[i], before[i] = longest[k] + 1, k
    chain, i = [], int(np.argmax(longest))
    while i >= 0:
        chain.append(i)
        i = before[i]
    return chain[::-1]


@given(
    points=st.lists(
        st.tuples(st.sampled_from([0.0, 1.0, 2.0, 29.0, 31.0]), st.integers(-3, 3)),
        min_size=1,
        max_size=40,
    )
)
def test_it_is_the_one_that_trying_all_finds(points: list[tuple[float, int]]) -> None:
    t = np.cumsum([step for step, _ in points])
    values = np.column_stack([100.0 * t, [150.0 * off for _, off in points]])
    assert longest_chain(t, values, RATE, SLACK).tolist() == chain_by_trying_all(t, values)
