"""What is accepted of a number from outside: the library's own ranges, in its own sentences."""

from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from relguide.contract.wanted import ACCEPTED
from relguide.planning.inputs import Range


@dataclass(frozen=True, slots=True)
class Accepted:
    """To annotate a float with: it must lie in a range, and the schema says so."""

    range: Range

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """The checks of the type itself, and after them the range."""
        low, high = self.range.ends

        def check(value: float) -> float:
            if low <= value <= high:
                return value
            raise ValueError(self.range.refusal(value))

        return core_schema.no_info_after_validator_function(
            check, handler(source), metadata={ACCEPTED: self.range}
        )

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """The type itself, with the ends of the range."""
        return {**handler(schema), "minimum": self.range.low, "maximum": self.range.high}
