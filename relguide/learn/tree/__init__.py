"""The paper's own method: its tree of regular trajectories and its network."""
