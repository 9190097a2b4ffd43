"""Arrays in a .safetensors file: eight bytes of length, a JSON header, then the raw numbers.

    length of the header, little-endian · {name: {dtype, shape, data_offsets}, …} · the arrays

Nothing in such a file is run, and numpy is all it takes to read one. The header must account for
every byte that follows it, so a file cut short is noticed. The format is that of
https://github.com/huggingface/safetensors.
"""

import json
from collections.abc import Mapping
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

Arrays = dict[str, NDArray[Any]]
TYPES = {
    "F64": "<f8", "F32": "<f4", "F16": "<f2", "I64": "<i8", "I32": "<i4", "I16": "<i2",
    "I8": "<i1", "U8": "<u1", "BOOL": "?",
}  # fmt: skip
"""Names of the format, and numpy's."""
_NAMES = {np.dtype(code): name for name, code in TYPES.items()}
_LENGTH = 8
"""Bytes before the header."""


def pack(arrays: Mapping[str, NDArray[Any]], metadata: Mapping[str, str]) -> bytes:
    """A file's content.

    Args:
        arrays: by their names; of the types in `TYPES`.
        metadata: texts to go with them.
    """
    # the largest numbers first, so that each array begins where its numbers may be read from
    names = sorted(arrays, key=lambda name: (-arrays[name].dtype.itemsize, name))
    header: dict[str, Any] = {"__metadata__": dict(metadata)}
    content, end = [], 0
    for name in names:
        array = arrays[name]
        begin, end = end, end + array.nbytes
        header[name] = {
            "dtype": _NAMES[array.dtype],
            "shape": array.shape,
            "data_offsets": (begin, end),
        }
        content.append(array.tobytes())
    text = json.dumps(header, ensure_ascii=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 8)
    return len(text).to_bytes(_LENGTH, "little") + text + b"".join(content)


def unpack(content: bytes) -> tuple[dict[str, str], Arrays]:
    """The metadata and the arrays of a file.

    Raises:
        ValueError: if it is no such file, or is cut short; LookupError or TypeError if its header
            is not of this format.
    """
    end = _LENGTH + int.from_bytes(content[:_LENGTH], "little")
    if len(content) < _LENGTH or end > len(content):
        raise ValueError("The header is longer than the file.")
    header = json.loads(content[_LENGTH:end])
    data = content[end:]
    if not isinstance(header, dict):
        raise ValueError("The header is no JSON object.")
    metadata = header.pop("__metadata__", {})
    arrays, covered = {}, 0
    for name, about in sorted(header.items(), key=lambda item: item[1]["data_offsets"][0]):
        kind, shape = np.dtype(TYPES[about["dtype"]]), tuple(about["shape"])
        first, last = about["data_offsets"]
        size = prod(shape) * kind.itemsize
        fits = first == covered and last == first + size <= len(data)
        if not fits or min(shape, default=0) < 0:
            raise ValueError(f"{name} does not lie where the header says.")
        arrays[name] = np.frombuffer(data, kind, prod(shape), first).reshape(shape).copy()
        covered = last
    if covered != len(data):
        raise ValueError("There is more in the file than the header says.")
    return metadata, arrays
