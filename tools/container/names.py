"""A name server, as an engine has one at 127.0.0.11, that reads a file such as `/etc/hosts`:

python -m tools.container.names FILE ADDRESS PORT
"""

import socket
import struct
import sys
from pathlib import Path

TIME_TO_LIVE = 1
"""Of an answer [s]."""
ADDRESS_RECORD, INTERNET = 1, 1
UNKNOWN = 3


def main(arguments: list[str]) -> None:
    """Answer until stopped."""
    file, host, port = arguments
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind((host, int(port)))
        while True:
            question, asker = served.recvfrom(512)
            served.sendto(answer(question, Path(file).read_text()), asker)


def answer(question: bytes, hosts: str) -> bytes:
    """The answer to one question (RFC 1035, 4): all addresses of a name.

    Args:
        question: as it came.
        hosts: lines of an address and names.
    """
    labels, place = [], 12
    while length := question[place]:
        labels.append(question[place + 1 : place + 1 + length].decode().lower())
        place += length + 1
    name, end = ".".join(labels), place + 5
    (kind,) = struct.unpack_from("!H", question, place + 1)
    lines = [line.split() for line in hosts.splitlines()]
    addresses = [line[0] for line in lines if name in line[1:]]
    known = addresses if kind == ADDRESS_RECORD else []
    # of the name in the question, which begins at byte 12
    records = [
        struct.pack("!HHHIH4s", 0xC00C, ADDRESS_RECORD, INTERNET, TIME_TO_LIVE, 4,
                    socket.inet_aton(address))
        for address in known
    ]  # fmt: skip
    flags = 0x8180 | (0 if addresses else UNKNOWN)
    head = question[:2] + struct.pack("!HHHHH", flags, 1, len(records), 0, 0)
    return head + question[12:end] + b"".join(records)


if __name__ == "__main__":
    main(sys.argv[1:])
