"""HTTP: what every request and answer passes, and the pages that describe them."""
