"""Pictures of docs/ that are drawn from the library's own answers."""
