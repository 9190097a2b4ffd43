"""The service for programs: `Client` and `AsyncClient`, which speak of situations and documents.

Both take the library's own `Situation` (or a body as the REST API takes it) and give its own cards
and documents, in SI units and radians. What came with latitude and longitude is `Placed`: it has
`lat_deg` and `lon_deg` [°] as well. Fields and documents that a newer service adds are passed over.
"""

from relguide.planning.extras import add_command

try:
    from relguide.client.async_client import AsyncClient, AsyncFlight
    from relguide.client.calls import Answer, Invalid, Refused
    from relguide.client.sync_client import Client, Flight
    from relguide.contract.document_models import Placed
except ModuleNotFoundError as error:
    raise add_command(error) from None

__all__ = [
    "Answer",
    "AsyncClient",
    "AsyncFlight",
    "Client",
    "Flight",
    "Invalid",
    "Placed",
    "Refused",
]
