"""The tables of the records. A change here needs a revision in `migrations/versions`."""

from sqlalchemy import (
    BigInteger,
    Boolean,
    Column,
    Double,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    String,
    Table,
    Text,
)

HEAD = "0003"
"""The newest revision."""

metadata = MetaData()


def _of_flight() -> Column[str]:
    """The column of what goes with its flight."""
    flight = ForeignKey("flights.id", ondelete="CASCADE")
    return Column("flight_id", String(32), flight, primary_key=True)


runs = Table(
    "runs",
    metadata,
    Column("id", String(32), primary_key=True),
    Column("host", String(255), nullable=False),
    Column("version", String(50), nullable=False),
    Column("started_at", Double, nullable=False),
    Column("seen_at", Double, nullable=False),
    # counts while flights of this run are in the air: one that stands still has been killed
    Column("beat", BigInteger, nullable=False),
)
"""Each start of the service."""

flights = Table(
    "flights",
    metadata,
    Column("id", String(32), primary_key=True),
    Column("run", String(32), ForeignKey("runs.id"), nullable=False, index=True),
    Column("scenario", String(100), nullable=False),
    Column("title", Text, nullable=False),
    Column("request", Text, nullable=False),
    Column("settings", Text, nullable=False),
    Column("seed", BigInteger, nullable=False),
    Column("version", String(50), nullable=False),
    # of the documents' form, as in the first line of a recording
    Column("form", Integer, nullable=False),
    Column("requested_by", String(255), nullable=False),
    Column("started_at", Double, nullable=False, index=True),
    Column("ended_at", Double),
    Column("outcome", String(20), nullable=False, index=True),
    Column("documents", Integer, nullable=False),
    Column("lost", Integer, nullable=False),
    Column("size", BigInteger, nullable=False),
    Column("figures", Text, nullable=False),
)

chunks = Table(
    "chunks",
    metadata,
    _of_flight(),
    # number of the first document in it
    Column("first", Integer, primary_key=True, autoincrement=False),
    Column("count", Integer, nullable=False),
    # flight time of the first
    Column("t", Double, nullable=False),
    # JSON lines, deflated
    Column("body", LargeBinary, nullable=False),
)
"""The documents of a flight, some dozens together."""

commands = Table(
    "commands",
    metadata,
    _of_flight(),
    Column("number", Integer, primary_key=True, autoincrement=False),
    Column("at", Double, nullable=False),
    Column("t", Double, nullable=False),
    Column("body", Text, nullable=False),
    Column("sent_by", String(255), nullable=False),
)

plans = Table(
    "plans",
    metadata,
    Column("run", String(32), ForeignKey("runs.id"), primary_key=True),
    Column("number", BigInteger, primary_key=True, autoincrement=False),
    Column("at", Double, nullable=False),
    Column("body", Text, nullable=False),
    Column("planner", String(20), nullable=False),
    Column("status", String(20), nullable=False),
    Column("seconds", Double, nullable=False),
    Column("asked_by", String(255), nullable=False),
    Index("plans_at", "at"),
)
"""Situations that were planned."""

clearances = Table(
    "clearances",
    metadata,
    Column("id", String(32), primary_key=True),
    Column("run", String(32), ForeignKey("runs.id"), nullable=False, index=True),
    Column("at", Double, nullable=False, index=True),
    Column("changed_at", Double, nullable=False),
    # no key of the flights: one that is not recorded asks as well
    Column("flight_id", String(32), nullable=False),
    Column("state", String(20), nullable=False),
    Column("over", Boolean, nullable=False),
    Column("request", Text, nullable=False),
    Column("card", Text, nullable=False),
    Column("owner", String(255), nullable=False),
    Column("asked_by", String(255), nullable=False),
)
"""Clearances asked for, as they are now."""
