"""Clearances over REST and streams: skies, the desk that answers, reports of traffic."""
