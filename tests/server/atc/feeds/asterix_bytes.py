"""ASTERIX records put together byte by byte as the standard's tables say, by no library."""

import struct


def block(category: int, *records: bytes) -> bytes:
    """A data block: category, length of the whole, records."""
    body = b"".join(records)
    return struct.pack(">BH", category, 3 + len(body)) + body


def letters(text: str) -> bytes:
    """Eight characters of six bits: A is 1, a space 32, 0 is 48."""
    packed = 0
    for letter in text.ljust(8):
        packed = packed << 6 | (ord(letter) - 64 if letter.isalpha() else ord(letter))
    return packed.to_bytes(6, "big")


def track_062(
    *, tod: float, lat: float, lon: float, east: float, north: float, callsign: str = "BAW12",
    level: float = 310.0, climb: float = 0.0, number: int = 77, ended: bool = False,
) -> bytes:  # fmt: skip
    """A record of category 062 with the items 010, 070, 105, 185, 245, 040, 080, 136, 220.

    Field reference numbers: 1, 4, 5, 7 | 10, 12, 13 | 17, 20.
    """
    return b"".join(
        (
            bytes([0b1001_1011, 0b0010_1101, 0b0010_0100]),
            bytes([25, 7]),
            round(tod * 128).to_bytes(3, "big"),
            struct.pack(">ii", round(lat * 2**25 / 180), round(lon * 2**25 / 180)),
            struct.pack(">hh", round(east * 4), round(north * 4)),
            b"\x00" + letters(callsign),
            struct.pack(">H", number),
            # MON SPI MRH SRC3 CNF FX | SIM TSE TSB FPC AFF STP KOS FX
            bytes([0x01, 0x40]) if ended else b"\x00",
            struct.pack(">h", round(level * 4)),
            struct.pack(">h", round(climb / 6.25)),
        )
    )


def report_021(
    *, tod: float, lat: float, lon: float, speed_kt: float, track: float, address: int = 0x4CA1FE,
    callsign: str = "EIN5LJ", level: float = 370.0, climb: float = 0.0, ground: bool = False,
) -> bytes:  # fmt: skip
    """A record of category 021 with the items 010, 040, 131, 080, 073, 145, 155, 160, 170.

    Field reference numbers: 1, 2, 7 | 11, 12 | 21 | 24, 26 | 29.
    """
    return b"".join(
        (
            bytes([0b1100_0011, 0b0001_1001, 0b0000_0011, 0b0010_1001, 0b1000_0000]),
            bytes([25, 8]),
            # ATP3 ARC2 RC RAB FX | DCR GBS SIM TST SAA CL2 FX
            bytes([0x01, 0x40]) if ground else b"\x00",
            struct.pack(">ii", round(lat * 2**30 / 180), round(lon * 2**30 / 180)),
            address.to_bytes(3, "big"),
            round(tod * 128).to_bytes(3, "big"),
            struct.pack(">h", round(level * 4)),
            struct.pack(">H", round(climb / 6.25) & 0x7FFF),
            struct.pack(">HH", round(speed_kt / 3600 * 2**14), round(track * 2**16 / 360)),
            letters(callsign),
        )
    )
