"""Pictures: SVG and matplotlib, and nothing else."""
