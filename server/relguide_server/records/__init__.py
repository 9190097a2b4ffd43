"""What the service keeps: flights with their documents and commands, and plans asked for."""
