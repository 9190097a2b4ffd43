"""How soon words can lead from sets of poses to others: proved for all poses of a set at once."""
