"""The files that the commands of catkin write, from the templates in the folder ``templates``."""

from __future__ import annotations

import re
from pathlib import Path


def filled(template: str, /, **values: str) -> str:
    """Return the text of a template, with a value for each ``@name@``."""
    text = (Path(__file__).with_name("templates") / f"{template}.in").read_text(encoding="utf-8")
    return re.sub(r"@(\w+)@", lambda found: values[found[1]], text)
