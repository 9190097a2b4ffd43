"""The network of branches: which words to solve where the limit does not bind."""
