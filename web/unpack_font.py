"""A font as programs read it (.ttf) from one as browsers do (.woff): only packed otherwise."""

import struct
import zlib

ENTRY = struct.Struct(">4sIIII")
"""A table in .woff: tag, offset, packed length, length, checksum."""


def unpack_font(woff: bytes) -> bytes:
    """The same tables, unpacked and listed as OpenType has it.

    Raises:
        ValueError: if it is no .woff.
    """
    signature, flavour, _, count = struct.unpack_from(">4sIIH", woff)
    if signature != b"wOFF":
        raise ValueError(f"A .woff font begins with wOFF, not {signature!r}.")
    power = 1 << (count.bit_length() - 1)
    head = struct.pack(
        ">IHHHH", flavour, count, 16 * power, power.bit_length() - 1, 16 * (count - power)
    )
    directory, body = b"", b""
    for number in range(count):
        tag, offset, packed, length, checksum = ENTRY.unpack_from(woff, 44 + ENTRY.size * number)
        table = woff[offset : offset + packed]
        if packed < length:
            table = zlib.decompress(table)
        start = 12 + 16 * count + len(body)
        directory += struct.pack(">4sIII", tag, checksum, start, length)
        body += table + b"\0" * (-length % 4)
    return head + directory + body
