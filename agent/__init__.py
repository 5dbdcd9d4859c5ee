"""Learns: algorithms that suggest skill calls and train from human evaluative feedback. Only here is torch imported."""
