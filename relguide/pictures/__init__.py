"""Pictures of flights without a browser: the cockpit's own drawing, run in a small engine."""
