"""A borrowed array is the array itself; uncounted kernels make no arrays and hand none back."""

import pkgutil
import sys
from collections.abc import Iterator
from importlib import import_module
from typing import Any, NamedTuple, get_args, get_origin, get_type_hints

import numpy as np
import pytest
from numba import njit
from numba.core.dispatcher import Dispatcher

from relguide import kernels
from relguide.kernels.base.borrowed import borrowed, uncounted
from relguide.kernels.base.roots import FloatArray


class Inner(NamedTuple):
    numbers: FloatArray
    scale: float


class Outer(NamedTuple):
    inner: Inner
    taken: FloatArray


class Plain(NamedTuple):
    scale: float


@uncounted
def handed_on(of: Inner) -> Inner:
    return of


@uncounted
def asks_another(of: Inner) -> float:
    return handed_on(of).scale


@uncounted
def adds_up(of: Inner) -> tuple[float, Plain]:
    return of.numbers[1, 1], Plain(of.scale)


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


def has_array(hint: Any) -> bool:
    """Whether a type is one of arrays, or a tuple that holds any."""
    if get_origin(hint) is np.ndarray:
        return True
    inside = get_args(hint)
    if isinstance(hint, type) and hasattr(hint, "_fields"):
        inside = tuple(get_type_hints(hint).values())
    return any(has_array(part) for part in inside)


def hands_back_arrays(kernel: Dispatcher) -> bool:
    return has_array(get_type_hints(kernel.py_func)["return"])


def called_by(kernel: Dispatcher) -> list[Dispatcher]:
    function = kernel.py_func
    named = (function.__globals__.get(name) for name in function.__code__.co_names)
    return [called for called in named if isinstance(called, Dispatcher)]


def is_sound(kernel: Dispatcher) -> bool:
    return not any(hands_back_arrays(each) for each in (kernel, *called_by(kernel)))


def uncounted_kernels() -> Iterator[Dispatcher]:
    for module in pkgutil.walk_packages(kernels.__path__, "relguide.kernels."):
        for kernel in vars(import_module(module.name)).values():
            if isinstance(kernel, Dispatcher) and kernel.targetoptions.get("_nrt") is False:
                yield kernel


def test_no_uncounted_kernel_hands_back_an_array_nor_does_what_it_calls() -> None:
    found = {*uncounted_kernels()}
    assert len(found) > 20
    assert [kernel.__name__ for kernel in found if not is_sound(kernel)] == []


@pytest.mark.parametrize(
    ("kernel", "sound"), [(handed_on, False), (asks_another, False), (adds_up, True)]
)
def test_one_that_hands_back_an_array_is_found(kernel: Dispatcher, sound: bool) -> None:
    assert is_sound(kernel) == sound
