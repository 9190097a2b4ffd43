"""The doors of the service: connections and sockets, a share of them for each client."""
