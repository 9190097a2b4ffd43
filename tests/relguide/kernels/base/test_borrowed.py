"""A borrowed array is the array itself, and whose it is outlives it."""

import sys
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.borrowed import borrowed
from relguide.kernels.base.roots import FloatArray


class Inner(NamedTuple):
    numbers: FloatArray
    scale: float


class Outer(NamedTuple):
    inner: Inner
    taken: FloatArray


@njit
def add(of: Outer) -> None:
    of.taken[0] += of.inner.scale * of.inner.numbers[1, 1]


@njit
def add_often(of: Outer, times: int) -> None:
    lent = borrowed(of)
    for _ in range(times):
        add(lent)


def test_what_is_done_to_a_borrowed_array_is_done_to_it() -> None:
    outer = Outer(Inner(np.full((2, 2), 3.0), 0.5), np.zeros(1))
    add_often(outer, 1_000)
    assert outer.taken[0] == 1_500.0


def test_references_are_as_many_as_before() -> None:
    outer = Outer(Inner(np.full((2, 2), 3.0), 0.5), np.zeros(1))
    add_often(outer, 1)
    before = sys.getrefcount(outer.taken), sys.getrefcount(outer.inner.numbers)
    for _ in range(100):
        add_often(outer, 10)
    assert (sys.getrefcount(outer.taken), sys.getrefcount(outer.inner.numbers)) == before
