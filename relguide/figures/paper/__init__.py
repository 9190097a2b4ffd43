"""The paper's own figures, one file each."""
