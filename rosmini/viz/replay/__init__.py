"""A recorded run as a player that needs no server: `replay(recording)`, or `recording.replay()`.

`replay("demo.bag")` plays a bag; a `Run` of bodies and layers plays data that is not in messages.
"""

from __future__ import annotations

from rosmini.viz.replay.grids import Grid, Grids
from rosmini.viz.replay.layers import Shape, Shapes, Stroke, Strokes
from rosmini.viz.replay.player import ReplayView, replay
from rosmini.viz.replay.run import Body, Run

__all__ = ["Body", "Grid", "Grids", "ReplayView", "Run", "Shape", "Shapes", "Stroke", "Strokes", "replay"]
