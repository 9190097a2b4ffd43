"""What all trainings share: the loop, its options, checkpoints, files."""
