"""The scripts of the chapter Actions: run by the command on the page, they print what the page shows."""

from __future__ import annotations

from .conftest import assert_scripts_print_what_is_shown


def test_the_listed_scripts_print_what_is_shown(prose, tmp_path):
    assert_scripts_print_what_is_shown(prose, tmp_path, {"fibonacci_server.py", "fibonacci_client.py"})
