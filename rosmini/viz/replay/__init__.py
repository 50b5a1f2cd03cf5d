"""A recorded run as a player that needs no server: `replay(recording)`, or `recording.replay()`."""

from __future__ import annotations

from rosmini.viz.replay.canvas_data import scene_data
from rosmini.viz.replay.player import ReplayView, replay

__all__ = ["ReplayView", "replay", "scene_data"]
