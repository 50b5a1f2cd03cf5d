"""`tf/view_frames`: listens for five seconds and writes the tree of frames (http://wiki.ros.org/tf#view_frames)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.graph.show import show
from rosmini.core.tf.listener import TransformListener

if TYPE_CHECKING:
    from rosmini.core.graph import Node

LISTEN_S = 5.0


class ViewFrames:
    """Writes `frames.gv` (for graphviz) and `frames.svg` (drawn by rosmini) to the working directory.

    The real tool converts `frames.gv` to `frames.pdf`. `picture` is the drawing. The node then ends.
    """

    def __init__(self, node: Node, folder: str = ".") -> None:
        self.buffer = TransformListener(node).buffer
        print(f"Listening to /tf for {LISTEN_S} seconds")
        node.sleep(LISTEN_S)
        print("Done Listening")
        self.dot = self.buffer.all_frames_as_dot()
        self.picture: Any = show("tf_tree", self.buffer)
        Path(folder, "frames.gv").write_text(self.dot, encoding="utf-8")
        self.picture.save(Path(folder, "frames.svg"))
        print("frames.gv and frames.svg generated")
