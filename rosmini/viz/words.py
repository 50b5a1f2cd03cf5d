"""What texts of pictures have in common."""


def plural(count: int, noun: str) -> str:
    """A count with its noun: "1 topic", "2 topics"."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
