"""Remembers and decides: HTTP, WebSocket, database, the loop of each experiment. Loads neither torch nor MuJoCo."""
