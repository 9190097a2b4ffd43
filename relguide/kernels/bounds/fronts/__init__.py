"""How soon a path can go round the leader, without time to turn: fronts that sweep the disc."""
