"""The errors of Logo programs: what went wrong, in which line, in which procedure."""

from __future__ import annotations

from rosmini.errors import RosminiError, nearest


class LogoError(RosminiError):
    """A Logo program is not valid, or it failed: ``message`` in ``line`` (counted from 1) of ``procedure``."""

    def __init__(self, message: str, line: int | None = None, procedure: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.line = line
        self.procedure = procedure

    def __str__(self) -> str:
        where = [] if self.line is None else [f"line {self.line}"]
        where += [f"in {self.procedure}"] if self.procedure else []
        return f"{', '.join(where)}: {self.message}" if where else self.message

    def locate(self, line: int, procedure: str | None) -> None:
        """Note where it was raised, unless that is known."""
        if self.line is None:
            self.line, self.procedure = line, procedure


class LogoStopped(LogoError):
    """A Logo program was stopped because it took too many steps, or called too deep."""


class BadInput(LogoError):
    """A word of Logo does not take what it was given; the machine, which knows the word, completes the message."""

    def __init__(self, given: str, wanted: str) -> None:
        super().__init__(f"{given} is not {wanted}")
        self.given, self.wanted = given, wanted

    def name_word(self, word: str) -> None:
        """Say which word it was, the first time."""
        if self.message.endswith(f"is not {self.wanted}"):
            self.message = f"{word} doesn't like {self.given} as input: it needs {self.wanted}"


def suggestion(name: str, known: list[str]) -> str:
    """``"; did you mean ...?"``, or nothing."""
    guess = nearest(name, known)
    return f"; {guess}" if guess else ""
