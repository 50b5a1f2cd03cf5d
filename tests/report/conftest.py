"""Fixtures of the report's command lines: a notebook to type them into."""

from ..notebook.conftest import notebook, shell  # noqa: F401 - fixtures
