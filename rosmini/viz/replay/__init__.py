"""A recorded run as a player that needs no server: `replay(recording)`, or `recording.replay()`.

A bag is played by `replay("demo.bag")`; what no messages have is a `Run`, of bodies and layers.
`rosmini.viz.replay.time_travel.what_if` makes a run again with something changed at an instant of it.
"""

from __future__ import annotations

from rosmini.viz.replay.canvas_data import scene_data
from rosmini.viz.replay.grids import Grid, Grids
from rosmini.viz.replay.images import Images
from rosmini.viz.replay.layers import Layer, Scans, Shape, Shapes, Stroke, Strokes
from rosmini.viz.replay.player import ReplayView, replay
from rosmini.viz.replay.run import Body, Run

__all__ = [
    "Body",
    "Grid",
    "Grids",
    "Images",
    "Layer",
    "ReplayView",
    "Run",
    "Scans",
    "Shape",
    "Shapes",
    "Stroke",
    "Strokes",
    "replay",
    "scene_data",
]
