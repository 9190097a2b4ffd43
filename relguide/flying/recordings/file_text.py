"""The text of a file, packed or not, whatever byte-order mark it begins with."""

import gzip
import zlib
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from pathlib import Path

PACKED = b"\x1f\x8b"
"""How gzip's files begin."""


def text_of(path: Path) -> str:
    """All text of a file: UTF-8, or UTF-16 with its mark, as spreadsheets write it.

    Raises:
        ValueError: if it is something else, in a sentence.
        OSError: if it cannot be opened.
    """
    content = path.read_bytes()
    if content.startswith(PACKED):
        try:
            content = gzip.decompress(content)
        except (OSError, EOFError, zlib.error):
            raise ValueError(f"{path} is damaged: it cannot be unpacked.") from None
    wide = content.startswith((BOM_UTF16_LE, BOM_UTF16_BE))
    try:
        return content.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError:
        raise ValueError(f"{path} is not UTF-8 text.") from None
