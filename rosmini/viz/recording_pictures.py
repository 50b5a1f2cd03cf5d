"""A recorded run: its path from above, and its velocities and odometry error over time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.sim.recording import Drift, Moved, Recording
from rosmini.viz.beams import beams_of
from rosmini.viz.figures import WIDTH, add_axes, blank_figure, house_style, legend, set_ticks, step_of
from rosmini.viz.rounding import degrees, fixed, points_to_keep, snap
from rosmini.viz.style import LABEL_SIZE, LIGHT
from rosmini.viz.view import Picture, ViewError, matplotlib_picture
from rosmini.viz.words import plural
from rosmini.viz.world_drawing import DASHES
from rosmini.viz.world_pictures import HEIGHT, Other, Scene, pose_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Floats = NDArray[np.float64]

LEFT, GAP, TOP, BOTTOM, ROW_GAP = 50.0, 66.0, 58.0, 42.0, 50.0
"""Margins around the plots and gaps between them [px]."""
STROKE = 1.8
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
            f"The way of a robot in the world {run.world.name}, from above: a solid line from "
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


def recording_plots(
    recording: Recording, *, odometry: bool = True, title: str | None = None, width: float = WIDTH
) -> Picture:
    """Plot a run over time: the commanded and the actual velocities, and the error of odometry.

    Args:
        recording: the run.
        odometry: True to plot the odometry error beside the velocities.
        title: a caption under the picture, and the first words of its text form.
        width: width of the picture [CSS px].

    Raises:
        ViewError: it is not a recording, or it has no duration.

    """
    run = _checked(recording)
    if not run.duration:
        raise ViewError("a run without duration cannot be plotted over time: let the simulation run longer")
    with house_style():
        figure = _plots(run, width, odometry=odometry)
        text, alt = _plots_text(run, title, odometry=odometry), _plots_alt(run, odometry=odometry)
        return matplotlib_picture(figure, text=text, alt=alt, form="svg", caption=title)


def _plots(run: Recording, width: float, *, odometry: bool) -> Figure:
    row = 132.0
    column = (width - 2 * LEFT - GAP + 40.0) / 2 if odometry else width - 2 * LEFT + 40.0
    figure = blank_figure(width, TOP + 2 * row + ROW_GAP + BOTTOM)
    driven, drift = run.velocities(), run.drift()
    span = (float(run.times[0]), float(run.times[-1]))
    for i, unit, label in ((0, "m/s", "linear velocity"), (1, "rad/s", "angular velocity")):
        axes = add_axes(figure, LEFT, TOP + i * (row + ROW_GAP), column, row)
        given = run.commands[:, i + 1]
        _frame(axes, f"{label} [{unit}]", span, np.concatenate([driven[:, i], given]), 0.1, last=i == 1)
        _curve(axes, run.times, driven[:, i], "blue", label="driven")
        if len(given):
            times = np.append(np.repeat(run.commands[:, 0], 2)[1:], span[1])
            _curve(axes, times, np.repeat(given, 2), "orange", dashed=True, label="commanded")
    errors = (
        (drift.position, "odometry: position error [m]"),
        (np.rad2deg(drift.heading), "odometry: heading error [deg]"),
    )
    for i, (values, label) in enumerate(errors if odometry else ()):
        axes = add_axes(figure, LEFT + column + GAP, TOP + i * (row + ROW_GAP), column, row)
        _frame(axes, label, span, values, (0.01, 1.0)[i], last=i == 1)
        _curve(axes, run.times, values, "vermilion")
    handles, _ = figure.axes[0].get_legend_handles_labels()
    legend(figure, handles, LEFT)
    return figure


def _frame(axes: Axes, label: str, span: tuple[float, float], values: Floats, least: float, *, last: bool) -> None:
    """Set limits and ticks around `values` and zero, at least `least` high, and a title."""
    low, high = min(0.0, float(values.min())), max(0.0, float(values.max()))
    if high - low < least:
        high = low + least
    low, high = 1.06 * low, 1.06 * high  # a line along the edge would be invisible
    step = step_of(high - low, 4)
    bottom, top = math.floor(low / step + 0.0137) * step, math.ceil(high / step - 0.0137) * step
    axes.set(xlim=span, ylim=(bottom, top))
    set_ticks(axes.xaxis, *span, step_of(span[1] - span[0], 6))
    set_ticks(axes.yaxis, bottom, top, step)
    axes.set_title(label, loc="left", fontsize=LABEL_SIZE, color=LIGHT["ink"], pad=7.0)
    axes.axhline(0.0, color=LIGHT["group-line"], linewidth=1.0, zorder=1.5)
    if last:
        axes.set_xlabel("time [s]")


def _curve(axes: Axes, times: Floats, values: Floats, colour: str, *, dashed: bool = False, label: str = "") -> None:
    """Draw a line over time, with only the points that matter, rounded to a twentieth of a pixel."""
    box = axes.get_window_extent()
    size = np.array([box.width, box.height])
    limits = np.array([axes.get_xlim(), axes.get_ylim()])
    extent = limits[:, 1] - limits[:, 0]
    pixels = snap((np.column_stack([times, values]) - limits[:, 0]) / extent * size, 0.05)
    points = pixels[points_to_keep(pixels, 0.137)] / size * extent + limits[:, 0]
    dashes: dict[str, Any] = {"dashes": DASHES} if dashed else {}
    axes.plot(*points.T, color=LIGHT[colour], linewidth=STROKE, label=label, zorder=4.0, clip_on=False, **dashes)


def _plots_text(run: Recording, title: str | None, *, odometry: bool) -> str:
    driven = np.abs(run.velocities()).max(axis=0)
    lines = [
        f"{title or f'run in {run.world.name}'}: {fixed(run.duration, 1)} s, {plural(len(run.commands), 'command')}",
        f"driven: at most {fixed(driven[0], 2)} m/s and {fixed(driven[1], 2)} rad/s",
    ]
    if len(run.commands):
        given = np.abs(run.commands[:, 1:]).max(axis=0)
        lines.insert(1, f"commanded: at most {fixed(given[0], 2)} m/s and {fixed(given[1], 2)} rad/s")
    if not odometry:
        return "\n".join(lines)
    drift = run.drift()
    lines.append(
        f"odometry: {_drift_text(drift)} at the end; at most {fixed(drift.position.max(), 3)} m and "
        f"{fixed(float(np.rad2deg(np.abs(drift.heading).max())), 1)} deg"
    )
    return "\n".join(lines)


def _plots_alt(run: Recording, *, odometry: bool) -> str:
    driven = np.abs(run.velocities()).max(axis=0)
    error = f" The error of odometry: {_drift_text(run.drift())} at the end." if odometry else ""
    return (
        f"{'Four' if odometry else 'Two'} plots over {fixed(run.duration, 1)} s. The velocities, as commanded by "
        f"{plural(len(run.commands), 'message')} and as driven: the robot reaches {fixed(driven[0], 2)} m/s and "
        f"{fixed(driven[1], 2)} rad/s.{error}"
    )


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
