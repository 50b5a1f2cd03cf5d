"""A recorded run: its path from above."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.sim.recording import Drift, Moved, Recording
from rosmini.viz.beams import beams_of
from rosmini.viz.figures import WIDTH
from rosmini.viz.rounding import degrees, fixed
from rosmini.viz.view import Picture, ViewError
from rosmini.viz.words import plural
from rosmini.viz.world_pictures import HEIGHT, Other, Scene, pose_text

Floats = NDArray[np.float64]

MIN_MOVED = 0.005
"""Minimum distance that counts as movement of an object [m]."""


class RunScene(Scene):
    """The end of a run, and the path to it."""

    def __init__(self, recording: Recording, *, scan: bool) -> None:
        end = float(recording.times[-1])
        super().__init__(recording.world_at(end) if recording.things else recording.world, recording.model)
        self.recording = recording
        self.trail = recording.truth
        self.odom = recording.odom_in_map()
        self.robot = _pose(self.trail[-1])
        self.ghost = _pose(self.odom[-1])
        self.name = recording.name
        self.others = [Other(run.name, run.model, run.pose_at(end), run.truth) for run in recording.others]
        moved = [thing for thing in recording.things if thing.distance > MIN_MOVED]
        self.former_places = [thing.obstacle for thing in moved]
        self.moved_paths = [(thing.poses[:, :2], thing.obstacle.colour) for thing in moved]
        if scan:
            if not len(recording.scans):
                raise ViewError("no scan was recorded: omit scan=True, or let the simulation run longer")
            each = recording.scan_poses(-1)
            self.add_scan(beams_of(recording.scans[-1], self.model.laser), _pose(each[0]), each)

    def text(self, title: str | None) -> str:
        """The run in numbers."""
        run = self.recording
        name = run.name if run.others and run.name else run.model.name
        recorded = ((run.times, "pose"), (run.scans, "scan"), (run.commands, "command"))
        lines = [
            f"{title or f'run in {run.world.name}'}: {fixed(run.distance, 2)} m in {fixed(run.duration, 1)} s",
            f"{name}: start {pose_text(run.truth[0])}, end {pose_text(run.truth[-1])}",
            f"odometry: {_drift_text(run.drift())} at the end",
            f"recorded: {', '.join(plural(len(of), what) for of, what in recorded)}",
        ]
        lines += [_other_text(other) for other in run.others]
        lines += [f"{thing.obstacle.name}: moved {fixed(thing.distance, 2)} m" for thing in self._moved()]
        if self.beams is not None:
            lines.append(f"last scan: {self.beams.text()}")
        return "\n".join(lines)

    def alt(self) -> str:
        """The run in sentences."""
        run = self.recording
        seen = f" In its last scan, {self.beams.clause()}." if self.beams is not None else ""
        return (
            f"The path of a robot in the world {run.world.name}, from above: a solid line from "
            f"{pose_text(run.truth[0])} to {pose_text(run.truth[-1])}, {fixed(run.distance, 2)} m long, "
            f"driven in {fixed(run.duration, 1)} s. "
            f"A dashed line shows where odometry believes that it was: {_drift_text(run.drift())} at the end."
            f"{self._beside()}{seen}"
        )

    def _moved(self) -> list[Moved]:
        return [thing for thing in self.recording.things if thing.distance > MIN_MOVED]

    def _beside(self) -> str:
        """Return sentences about other robots and objects that moved."""
        others, moved = self.recording.others, [thing.obstacle.name for thing in self._moved()]
        said = ""
        if others:
            ways = [f"{run.name} drove {fixed(run.distance, 2)} m" for run in others[:6]]
            more = f", and {len(others) - 6} more" if len(others) > 6 else ""
            said += f" Beside it {', '.join(ways)}{more}."
        if moved:
            said += f" Moved, with a dashed outline where it stood at first: {', '.join(moved)}."
        return said


def recording_picture(
    recording: Recording, *, scan: bool = False, title: str | None = None, size: tuple[float, float] = (WIDTH, HEIGHT)
) -> Picture:
    """Draw a run from above: the true path of the robot, and its path by odometry, both with the same start.

    The robot is drawn at the end of both paths: solid at its true pose, with a dashed outline at its pose by odometry.
    Other robots have colours and names. Recorded objects are drawn where they ended, and with dashes where they began.

    Args:
        recording: the run.
        scan: True to draw the last scan too, from where it was taken.
        title: a caption under the picture, and the first words of its text form.
        size: the largest width and height [CSS px].

    Raises:
        ViewError: it is not a recording, or it has no scan to draw.

    """
    return RunScene(_checked(recording), scan=scan).picture(title, size)


def _other_text(run: Recording) -> str:
    end = pose_text(run.truth[-1])
    return f"{run.name} ({run.model.name}): {fixed(run.distance, 2)} m, start {pose_text(run.truth[0])}, end {end}"


def _drift_text(drift: Drift) -> str:
    return f"{fixed(drift.position[-1], 3)} m and {degrees(float(drift.heading[-1]))} deg off"


def _checked(recording: Recording) -> Recording:
    if not isinstance(recording, Recording):
        hint = ": call its recording() first" if hasattr(recording, "recording") else ""
        raise ViewError(f"a run is drawn from a Recording, not from a {type(recording).__name__}{hint}")
    return recording


def _pose(row: Floats) -> Pose:
    x, y, heading = row.tolist()
    return (x, y, heading)
