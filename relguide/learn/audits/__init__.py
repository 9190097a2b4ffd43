"""How good the networks are: held against exact answers, in bulk, class by class."""
