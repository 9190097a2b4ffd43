"""What leaders fly: an intent, a recording, orders, or something drawn at random."""
