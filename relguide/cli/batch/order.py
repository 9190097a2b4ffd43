"""Order: what is asked of a batch, and of what form its files are."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from relguide.contract.answers import Include
    from relguide.contract.bulk import Fields

Form = Literal["jsonl", "csv", "parquet"]
FORMS: tuple[Form, ...] = ("jsonl", "csv", "parquet")
"""How files are written: a JSON object a line, comma-separated values, Parquet."""
ENDINGS: dict[str, Form] = {".csv": "csv", ".parquet": "parquet", ".pq": "parquet"}
"""Of files that are not JSON lines."""
AT_ONCE = {"times": 2000, "plan": 200, "full": 20}
"""Lines in a chunk: some 50 ms of work, where no path has to be searched."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BatchOrder:
    """What is asked of each line, and how lines and answers are written."""

    source: Form
    header: tuple[str, ...] = ()
    """Names of the columns, where they are not in each chunk: of CSV."""
    whole_ids: bool = False
    """Whether `id` is a column of whole numbers."""
    amid: bool = False
    """Whether situations may have other traffic, cells or heights: answers in columns have then
    more of them."""
    to: Form
    fields: "Fields" = "plan"
    include: "tuple[Include, ...]" = ()
    planner: str = "exact"
    prove: float = 0.0
    """How long to look for a better lower bound [s]."""
    deadline: float | None = None
    """Of each line [s]."""

    @property
    def at_once(self) -> int:
        """How many lines a chunk has at most."""
        if self.prove or self.deadline or self.planner == "regular_dp":
            return 1
        return AT_ONCE["full" if self.include else self.fields]


def form_of(file: str, chosen: Form | None) -> Form:
    """The form of a file: as chosen, or by its ending."""
    return chosen or ENDINGS.get(Path(file).suffix.lower(), "jsonl")
