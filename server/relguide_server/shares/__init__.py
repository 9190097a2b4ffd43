"""What clients share, and how much of it one may take."""
