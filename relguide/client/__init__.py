"""The service for programs: `Client` and `AsyncClient`, which speak of situations and documents.

Both take the library's own `Situation` (or a body as the REST API takes it) and give its own cards
and documents, in SI units and radians. They read services of their own version of relguide.
"""

from relguide.client.async_client import AsyncClient, AsyncFlight
from relguide.client.calls import Answer, Invalid, Refused
from relguide.client.sync_client import Client, Flight

__all__ = ["Answer", "AsyncClient", "AsyncFlight", "Client", "Flight", "Invalid", "Refused"]
