"""Helpers for the text forms of pictures."""


def plural(count: int, noun: str) -> str:
    """Return a count with its noun: "1 topic", "2 topics"."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
