"""The chapter Services: its scripts print what the page shows, and it is right about the tools."""

from __future__ import annotations

import re

from rosmini.msgs import service_class

from .conftest import assert_scripts_print_what_is_shown


def test_the_listed_scripts_print_what_is_shown(prose, tmp_path):
    assert_scripts_print_what_is_shown(prose, tmp_path, {"add_server.py", "add_client.py"})


def test_the_answers_of_rossrv_are_true(prose):
    box = re.search(r"\$ rossrv show (\S+)\n(.*?)\n\n\$ rossrv md5 (\S+)\n(\w+)", prose, re.DOTALL)
    shown, text, fingerprinted, md5 = box.groups()
    cls = service_class(shown)
    halves = [
        [f"{field.type} {field.name}" for field in half._spec.fields]
        for half in (cls._request_class, cls._response_class)
    ]
    assert text.splitlines() == [*halves[0], "---", *halves[1]]
    assert service_class(fingerprinted)._md5sum == md5
