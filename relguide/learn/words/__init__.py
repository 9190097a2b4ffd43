"""The branch network: which words to solve where the limit does not bind."""
