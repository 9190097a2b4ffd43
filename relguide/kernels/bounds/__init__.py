"""What is proved of a time: lower bounds by cells of contacts."""
