"""Build hook: write the type stubs of messages, `rosmini/msgs/<package>/msg.pyi`, to the checkout and the wheel.

They are not committed. An editable install (`uv sync`) leaves them where editors and type checkers look.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class StubsHook(BuildHookInterface):  # type: ignore[misc]
    """Runs before each build, editable or not."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:  # noqa: ARG002 (hatchling's signature)
        """Write the stubs, and add them to the build although Git ignores them."""
        sys.path.insert(0, self.root)
        from assets.generate.stubs import write_stubs

        write_stubs(Path(self.root, "rosmini", "msgs"))
        build_data["artifacts"].append("rosmini/msgs/*/*.pyi")
