"""The network of templates: which constrained paths to solve where the limit binds."""
