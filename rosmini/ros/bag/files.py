"""The files of a recording: their names, and the sequence of files when it is split."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

from .bag import Bag

if TYPE_CHECKING:
    from rosmini.core.time import Time


def base_name(output: str | None, prefix: str | None, now: Time, *, simulated: bool) -> str:
    """Return a recording's path without number and ``.bag``: ``output`` (-O), or ``prefix`` (-o) and the date.

    The date is local, as in ROS, but in UTC in simulated time, where nothing may depend on the machine.
    """
    if output is not None:
        return output.removesuffix(".bag")
    clock = time.gmtime(now.secs) if simulated else time.localtime(now.secs)
    date = time.strftime("%Y-%m-%d-%H-%M-%S", clock)
    return f"{prefix.removesuffix('.bag')}_{date}" if prefix else date


class BagFiles:
    """Opens one bag after another; a file is named ``.active`` until it is closed, as in ROS.

    Args:
        base: the path without number and ``.bag``.
        split: number the files, from 0.
        compression: of the files.
        chunk_threshold: of the files [bytes].

    """

    def __init__(self, base: str, *, split: bool, compression: str, chunk_threshold: int) -> None:
        self._base = base
        self._split = split
        self._compression = compression
        self._chunk_threshold = chunk_threshold
        self._number = 0
        self.bag: Bag | None = None
        self.paths: list[Path] = []
        """The finished files."""
        self.path = Path()
        """Final path of the open file."""

    def open(self) -> Bag:
        """Open the next file. Raises ``OSError`` if that is not possible."""
        number = f"_{self._number}" if self._split else ""
        self._number += 1
        self.path = Path(f"{self._base}{number}.bag")
        self.bag = Bag(self._active, "w", self._compression, self._chunk_threshold)
        return self.bag

    @property
    def _active(self) -> Path:
        return self.path.with_name(self.path.name + ".active")

    def close(self) -> None:
        """Close the open file, if any, and give it its final name. Raises ``BagFull`` as ``Bag.close`` does."""
        bag, self.bag = self.bag, None
        if bag is None:
            return
        try:
            bag.close()
        finally:
            self._active.replace(self.path)
            self.paths.append(self.path)
