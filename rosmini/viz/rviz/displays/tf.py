"""TF: all frames, their names, and an arrow from each to its parent."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from rosmini.core.geometry.products import norm
from rosmini.core.tf import TransformException
from rosmini.core.tf.rigid import matrix
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Display, Level
from rosmini.viz.rviz.primitives import Floats, Lines, Primitive, Text
from rosmini.viz.rviz.properties import Property, Tree
from rosmini.viz.rviz.shapes import axes

LENGTH, RADIUS, LETTER = 0.2, 0.02, 0.1
"""Dimensions of the axes, and height of the letters of names [m], at scale 1."""
SHAFT, HEAD = np.array([0.8, 0.8, 0.3, 1.0]), np.array([1.0, 0.1, 0.6, 1.0])
"""Colours of the arrows: yellow, with a pink end at the parent."""
MAX_FRAMES = 2000


class TF(Display, plugin="rviz/TF"):
    """The tree of frames."""

    properties = (
        Property("Show Names", True, "the frames' names"),
        Property("Show Axes", True, "the frames' axes"),
        Property("Show Arrows", True, "an arrow from each frame to its parent"),
        Property("Marker Scale", 1.0, "scale of axes, names and arrows", minimum=0.0, maximum=1e4),
        Property("Marker Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
        Property("Update Interval", 0.0, "not used: frames move with each picture", unit="s", minimum=0.0),
        Property("Frame Timeout", 15.0, "time without updates after which a frame is hidden", unit="s", minimum=1.0),
        Property("Filter (whitelist)", "", "a regular expression; not supported"),
        Property("Filter (blacklist)", "", "a regular expression; not supported"),
        Property("Frames", Tree({"All Enabled": True}), "which frames are shown"),
        Property("Tree", Tree(), "folded parts of the tree in RViz's window"),
    )

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Return the frames that have a transform to the fixed one; statuses explain why others are missing."""
        for each in self.statuses:
            self.clear_status(each.name)
        shown = [frame for frame in sorted(context.tree) if self._is_shown(frame)]
        if len(shown) > MAX_FRAMES:
            self.set_status(Level.WARN, "Frames", f"Showing {MAX_FRAMES} of {len(shown)} frames")
        poses: dict[str, Floats] = {}
        for frame in shown[:MAX_FRAMES]:
            try:
                poses[frame] = matrix(context.place(frame))
            except TransformException as error:
                said = str(error).partition("\n")[0]
                text = f"No transform from [{frame}] to frame [{context.fixed_frame}]. TF error: [{said}]"
                self.set_status(Level.WARN, frame, text)
                continue
            if self._is_dead(frame, context):
                self.set_status(Level.WARN, frame, "Not updated for longer than the Frame Timeout")
                del poses[frame]
                continue
            self.set_status(Level.OK, frame, "Transform OK")
        return list(self._drawn(poses, context))

    def _is_shown(self, frame: str) -> bool:
        frames = self["Frames"]
        one = frames.get(frame)
        value = one.get("Value") if isinstance(one, dict) else one
        return bool(frames.get("All Enabled", True) if value is None else value)

    def _is_dead(self, frame: str, context: Context) -> bool:
        """Return True if a frame has not been updated for too long; static frames and roots never time out."""
        edge = context.tree.edges.get(frame)
        if edge is None or edge.static:
            return False
        return bool(context.now_ns - edge.newest_ns > self["Frame Timeout"] * 1e9)

    def _drawn(self, poses: dict[str, Floats], context: Context) -> Iterator[Primitive]:
        scale, alpha = self["Marker Scale"], self["Marker Alpha"]
        fade = np.array([1.0, 1.0, 1.0, alpha])
        ends, colours = [], []
        for frame, pose in poses.items():
            if self["Show Axes"]:
                yield from axes(pose, LENGTH * scale, RADIUS * scale, alpha)
            parent = context.tree.parent(frame)
            if self["Show Arrows"] and parent in poses:
                start, end = pose[:3, 3], poses[parent][:3, 3]
                if norm(end - start) > 1e-6:
                    middle = start + (end - start) * 0.75
                    ends += [start, middle, middle, end]
                    colours += [SHAFT * fade, SHAFT * fade, HEAD * fade, HEAD * fade]
        if ends:
            yield Lines(np.array(ends), np.array(colours), 0.02 * scale, strip=False)
        for frame, pose in poses.items() if self["Show Names"] else ():
            yield Text(frame, pose[:3, 3], LETTER * scale, np.array([1.0, 1.0, 1.0, alpha]))
