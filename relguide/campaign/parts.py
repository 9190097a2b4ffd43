"""A campaign's folder: `parts/000123.parquet`, and `manifest.json`, which says what they are.

A part is written beside its name and moved there, so each that is there is whole. The manifest has
what was asked, the program that flew it, and of each part its rows and SHA-256.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_type_hints

from relguide.campaign.campaign_file import DERIVED, Campaign, read_campaign
from relguide.campaign.keys import KEYS
from relguide.campaign.row import Loss, Row
from relguide.learn.training.files import write_whole
from relguide.parallel.program import program
from relguide.planning.extras import need

if TYPE_CHECKING:
    import pyarrow as pa

FORMAT = "relguide-campaign 1"
PARTS, MANIFEST = "parts", "manifest.json"
KINDS = {bool: "bool_", int: "int64", float: "float64", str: "string"}
"""Arrow's types of ours; `float | None` is a float that may be missing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class KeptPart:
    """What the manifest says of a part."""

    rows: int
    sha256: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Manifest:
    """What a folder holds."""

    campaign: Campaign
    program: Mapping[str, str]
    """Packages with their versions, and a fingerprint of the code."""
    parts: Mapping[str, KeptPart]
    """By the name of their file."""


def part_name(number: int) -> str:
    """The file of a part."""
    return f"{number:06d}.parquet"


def write_manifest(folder: Path, manifest: Manifest) -> None:
    """Write it, whole or not at all."""
    content = {
        "format": FORMAT,
        **manifest.campaign.as_tables(),
        "program": dict(manifest.program),
        "parts": {name: asdict(part) for name, part in sorted(manifest.parts.items())},
    }
    with write_whole(folder / MANIFEST) as stream:
        stream.write(json.dumps(content, indent=1, ensure_ascii=False).encode() + b"\n")


def read_manifest(folder: Path) -> Manifest:
    """What a folder holds.

    Raises:
        ValueError: if it is no folder of a campaign.
    """
    file = folder / MANIFEST
    try:
        content = json.loads(file.read_bytes())
        if content.pop("format") != FORMAT:
            raise ValueError(f"{file} is of another form than {FORMAT}.")
        versions = content.pop("program")
        parts = {name: KeptPart(**part) for name, part in content.pop("parts").items()}
    except (FileNotFoundError, NotADirectoryError):
        raise ValueError(
            f"{folder} is no folder of a campaign: relguide campaign FILE.toml --out {folder} "
            "makes one."
        ) from None
    except (json.JSONDecodeError, KeyError, TypeError, AttributeError):
        raise ValueError(f"{file} is no manifest of a campaign.") from None
    return Manifest(campaign=read_campaign(content), program=versions, parts=parts)


def begin_folder(folder: Path, campaign: Campaign) -> Manifest:
    """The manifest of a run that begins, or of one that goes on; its parts are whole.

    Raises:
        ValueError: if the folder has flights of another campaign or of another program, which are
            never pooled, or something else.
    """
    ours = dict(program())
    if not (folder / MANIFEST).exists():
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise ValueError(f"{folder} holds something else: name an empty folder or a new one.")
        (folder / PARTS).mkdir(parents=True)
        begun = Manifest(campaign=campaign, program=ours, parts={})
        write_manifest(folder, begun)
        return begun
    found = read_manifest(folder)
    for name, version in ours.items():
        theirs = found.program.get(name, "none")
        if theirs != version:
            raise ValueError(
                f"{folder} was flown with {name} {theirs}, and here is {version}: flights of "
                "different versions are never put together. Name another folder."
            )
    if found.campaign != campaign:
        raise ValueError(
            f"{folder} is of a campaign that asks for something else in "
            f"{_difference(found, campaign)}: name another folder."
        )
    return Manifest(campaign=campaign, program=ours, parts=_whole_parts(folder, found))


def _difference(found: Manifest, campaign: Campaign) -> str:
    theirs, ours = found.campaign.as_tables(), campaign.as_tables()
    names = [
        f"{table}.{key}"
        for table in ("campaign", "vary", "sweep")
        for key in {**theirs[table], **ours[table]}
        if theirs[table].get(key) != ours[table].get(key)
    ]
    if theirs.get("crew") != ours.get("crew"):
        names.append("crew")
    return ", ".join(names)


def _whole_parts(folder: Path, found: Manifest) -> dict[str, KeptPart]:
    """The parts that are there, as the manifest says or later than it; damaged ones are not."""
    whole = {}
    for file in sorted((folder / PARTS).glob("*.parquet")):
        content = file.read_bytes()
        digest = sha256(content).hexdigest()
        known = found.parts.get(file.name)
        if known is None:
            whole[file.name] = KeptPart(rows=_row_count(file), sha256=digest)
        elif known.sha256 == digest:
            whole[file.name] = known
    return whole


def _row_count(file: Path) -> int:
    import pyarrow.parquet as pq

    return int(pq.read_metadata(file).num_rows)


def keep_part(folder: Path, name: str, content: bytes, rows: int) -> KeptPart:
    """Write a part, whole or not at all."""
    with write_whole(folder / PARTS / name) as stream:
        stream.write(content)
    return KeptPart(rows=rows, sha256=sha256(content).hexdigest())


def encode_part(rows: Sequence[Mapping[str, Any]], campaign: Campaign) -> bytes:
    """Rows as a Parquet file."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    sink = pa.BufferOutputStream()
    pq.write_table(pa.Table.from_pylist(list(rows), schema=schema(campaign)), sink)
    return bytes(sink.getvalue().to_pybytes())


def read_table(folder: Path) -> "pa.Table":
    """All flights of a folder, in their order.

    Raises:
        ValueError: if it is none of a campaign, or has no flights.
    """
    need("pyarrow")
    import pyarrow as pa
    import pyarrow.parquet as pq

    manifest = read_manifest(folder)
    if not manifest.parts:
        raise ValueError(f"{folder} has no flights yet.")
    return pa.concat_tables(pq.read_table(folder / PARTS / name) for name in sorted(manifest.parts))


def row_of_record(record: Mapping[str, Any]) -> Row:
    """A row from what the table has of it."""
    known = {field.name: record[field.name] for field in fields(Row)}
    return Row(**known | {"losses": tuple(Loss(**loss) for loss in known["losses"])})


def schema(campaign: Campaign) -> "pa.Schema":
    """The columns: the flight's number, what was drawn and swept, then the figures of `Row`."""
    import pyarrow as pa

    varied = [key for key in KEYS if key in varied_keys(campaign)]
    return pa.schema(
        [("flight", pa.int64()), *((key, pa.float64()) for key in varied), *_columns(Row)]
    )


def varied_keys(campaign: Campaign) -> set[str]:
    """The keys that differ from flight to flight."""
    derived = [DERIVED[family].vary for family in campaign.families if family in DERIVED]
    return {key for table in (*derived, campaign.vary, campaign.sweep) for key in table}


def _columns(record: type) -> "list[tuple[str, pa.DataType]]":
    import pyarrow as pa

    found = []
    for name, hint in get_type_hints(record).items():
        if hint == tuple[Loss, ...]:
            found.append((name, pa.list_(pa.struct(_columns(Loss)))))
        else:
            kind = next(kind for kind in KINDS if hint in (kind, kind | None))
            found.append((name, getattr(pa, KINDS[kind])()))
    return found
