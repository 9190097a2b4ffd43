"""The service: REST, streams, 3D scenes and the cockpit's page on one port."""
