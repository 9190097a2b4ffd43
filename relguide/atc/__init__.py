"""The controller's side: a pursuer's intent validated amid all others, answered, and watched."""
