"""The engine: what moves, touches and pushes, with no node in it. `engine.py` is its front; the rest is behind that."""
