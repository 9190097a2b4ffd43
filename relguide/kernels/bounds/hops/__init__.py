"""How long it takes from one contact to the next on the final leg, where no path can slide."""
