"""Arrays in .safetensors files, against the format's own library."""

import numpy as np
import pytest
from safetensors.numpy import load, save

from relguide.learn.training.tensor_file import TYPES, pack, unpack

ARRAYS = {
    name.lower(): np.arange(6).astype(code).reshape(1, 3, 2) for name, code in TYPES.items()
} | {
    "scalar": np.array(2.5, np.float32),
    "empty": np.empty((0, 4)),
}


def test_the_formats_own_library_reads_what_is_written() -> None:
    read = load(pack(ARRAYS, {"about": "ψ ≤ π"}))
    assert read.keys() == ARRAYS.keys()
    for name, array in ARRAYS.items():
        assert read[name].dtype == array.dtype
        np.testing.assert_array_equal(read[name], array)


def test_what_that_library_writes_is_read() -> None:
    metadata, read = unpack(save(ARRAYS, {"about": "ψ ≤ π"}))
    assert metadata == {"about": "ψ ≤ π"}
    assert read.keys() == ARRAYS.keys()
    for name, array in ARRAYS.items():
        assert read[name].dtype == array.dtype
        np.testing.assert_array_equal(read[name], array)


def test_a_file_cut_short_or_made_longer_is_refused() -> None:
    whole = pack({"a": np.arange(3.0), "b": np.arange(4, dtype=np.int8)}, {})
    for end in range(len(whole)):
        with pytest.raises(ValueError):  # noqa: PT011 - of json, unicode and ours
            unpack(whole[:end])
    with pytest.raises(ValueError, match="more in the file"):
        unpack(whole + b"\0")


@pytest.mark.parametrize(
    ("was", "now"),
    [
        (b'"shape":[3]', b'"shape":[4]'),
        (b'"shape":[3]', b'"shape":[-3]'),
        (b'"data_offsets":[0,24]', b'"data_offsets":[8,32]'),
        (b'"dtype":"F64"', b'"dtype":"F32"'),
    ],
)
def test_a_header_that_does_not_fit_is_refused(was: bytes, now: bytes) -> None:
    whole = pack({"a": np.arange(3.0)}, {})
    assert was in whole
    changed = whole.replace(was, now + b" " * (len(was) - len(now)))
    with pytest.raises(ValueError, match="a does not lie where the header says"):
        unpack(changed)
