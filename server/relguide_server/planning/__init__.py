"""What is calculated on request: plans, areas and simulations."""
