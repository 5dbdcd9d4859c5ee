"""Acts and sees: robots and their tasks. Knows nothing of learning, HTTP or SQL."""
