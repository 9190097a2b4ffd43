"""The shipped networks, evaluated and decoded for one situation without torch."""
