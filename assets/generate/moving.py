"""Pictures that move by themselves, without a script: the four on the cover, of which one is also in the README.

Each is an SVG with CSS animations. It follows the theme of the page, and stands still, at its last moment, for readers
who prefer reduced motion and in print. `python -m assets.generate.moving` makes them again, which drives for a minute.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.ros.launch import roslaunch
from rosmini.ros.scripts import rosrun
from rosmini.sim.recorder import Recorder
from rosmini.sim.recording import Recording
from rosmini.sim.world import World
from rosmini.viz.style import DARK, LIGHT

Floats = NDArray[np.float64]
FILMS = Path(__file__).resolve().parents[2] / "book" / "static" / "films"
WIDTH, HEIGHT = 320, 200
"""Of each picture [CSS px]."""
KEYFRAMES = 40
"""How many poses of a drive an animation passes through."""
ROBOT_SIZE = 0.18
"""The radius at which a robot is drawn in a house [m]: larger than it is, to be seen."""


class Film:
    """One moving picture, drawn in metres.

    Args:
        name: begins the names of its classes and animations, since several pictures share a page.
        title: what it shows, for readers who do not see it.
        bounds: x and y of the lower left and of the upper right corner [m].
        seconds: how long a run of the film takes.

    """

    def __init__(self, name: str, title: str, bounds: tuple[float, float, float, float], seconds: float) -> None:
        self.name, self.title, self.seconds = name, title, seconds
        left, bottom, right, top = bounds
        self.scale = min(WIDTH / (right - left), HEIGHT / (top - bottom))
        self._origin = (WIDTH / 2 - self.scale * (left + right) / 2, HEIGHT / 2 + self.scale * (bottom + top) / 2)
        self._parts: list[str] = []
        self._css: list[str] = []
        self._colours: set[str] = set()

    def px(self, points: Floats) -> Floats:
        """Points (n, 2) in metres as pixels, rounded to a tenth."""
        x, y = self._origin
        pixels = np.column_stack([x + self.scale * points[:, 0], y - self.scale * points[:, 1]])
        return np.asarray(np.round(pixels, 1) + 0.0, dtype=np.float64)

    def paint(self, colour: str) -> str:
        """A colour of the house style, as CSS."""
        if colour.startswith("#"):
            return colour
        self._colours.add(colour)
        return f"var(--{self.name}-{colour})"

    def background(self, colour: str) -> None:
        """Fill the picture."""
        self._parts.append(f'<rect width="{WIDTH}" height="{HEIGHT}" fill="{self.paint(colour)}"/>')

    def path(self, outlines: Iterable[Floats], *, fill: str = "", stroke: str = "", width: float = 1.0) -> None:
        """Draw outlines (n, 2) [m] as one path: closed if filled."""
        self._parts.append(self._path(outlines, fill=fill, stroke=stroke, width=width))

    def _path(
        self, outlines: Iterable[Floats], *, fill: str = "", stroke: str = "", width: float = 1.0, more: str = ""
    ) -> str:
        lines = [
            "M" + "L".join(f"{x:g} {y:g}" for x, y in self.px(outline)) + ("Z" if fill else "") for outline in outlines
        ]
        style = f'fill="{self.paint(fill) if fill else "none"}"'
        if stroke:
            style += f' stroke="{self.paint(stroke)}" stroke-width="{width:g}" stroke-linecap="round"'
        return f'<path d="{"".join(lines)}" {style}{more}/>'

    def world(self, world: World) -> None:
        """Draw the walls and things of a world."""
        self.path([each.outline() for each in world.obstacles if len(each.outline())], fill="muted")
        for each in world.obstacles:
            if not len(each.outline()):
                (x, y) = self.px(np.array([each.pose[:2]]))[0]
                radius = self.scale * float(each.shape.radius)  # type: ignore[union-attr]
                self._parts.append(f'<circle cx="{x:g}" cy="{y:g}" r="{radius:.1f}" fill="{self.paint("muted")}"/>')

    def robot(self, times: Floats, poses: Floats, colour: str, size: float, *, trail: bool = True) -> None:
        """Draw a robot that drives along poses (n, 3), with its trail."""
        kind = f"{self.name}-r{len(self._css)}"
        where = self.px(poses[:, :2])
        share = (times - times[0]) / (times[-1] - times[0])
        if trail:
            lengths = np.hypot(*np.diff(where, axis=0).T)
            driven = np.concatenate([[0.0], np.cumsum(lengths)]) / max(float(lengths.sum()), 1e-9)
            steps = "".join(
                f"{100 * t:.4g}%{{stroke-dashoffset:{1 - d:.3g}}}" for t, d in zip(share, driven, strict=True)
            )
            self._css.append(
                f"@keyframes {kind}t{{{steps}}}.{kind}t{{animation:{kind}t {self.seconds:g}s linear infinite}}"
            )
            more = f' class="{kind}t" pathLength="1" stroke-dasharray="1" stroke-linejoin="round" opacity="0.7"'
            self._parts.append(self._path([poses[:, :2]], stroke=colour, width=1.5, more=more))
        turns = -np.degrees(np.unwrap(poses[:, 2]))
        steps = "".join(
            f"{100 * t:.4g}%{{transform:translate({x:g}px,{y:g}px) rotate({a:.0f}deg)}}"
            for t, (x, y), a in zip(share, where, turns, strict=True)
        )
        radius = size * self.scale
        x, y = where[-1]
        self._css.append(f"@keyframes {kind}{{{steps}}}.{kind}{{animation:{kind} {self.seconds:g}s linear infinite}}")
        self._parts.append(
            f'<g class="{kind}" style="transform:translate({x:g}px,{y:g}px) rotate({turns[-1]:.0f}deg)">'
            f'<circle r="{radius:.1f}" fill="{self.paint(colour)}"/>'
            f'<path d="M0 0L{radius:.1f} 0" stroke="{self.paint("page")}" stroke-width="{max(radius / 3, 1):.1f}"/></g>'
        )

    def appear(self, outlines: Sequence[Floats], at: float, *, stroke: str, width: float = 1.0, fill: str = "") -> None:
        """Draw outlines that appear at a share of the film and stay."""
        kind = f"{self.name}-a{len(self._css)}"
        p = 100 * at
        steps = f"0%,{p:.4g}%{{opacity:0}}{min(p + 2, 100):.4g}%,100%{{opacity:1}}"
        self._css.append(f"@keyframes {kind}{{{steps}}}.{kind}{{animation:{kind} {self.seconds:g}s linear infinite}}")
        self._parts.append(self._path(outlines, fill=fill, stroke=stroke, width=width, more=f' class="{kind}"'))

    def frames(self, frames: Sequence[Sequence[Floats]], *, stroke: str, width: float) -> None:
        """Draw one of `frames` after the other, each for the same time; the last one where nothing moves."""
        kind, count = f"{self.name}-f{len(self._css)}", len(frames)
        share = 100 / count
        steps = f"0%{{visibility:visible}}{share:.4g}%,100%{{visibility:hidden}}"
        self._css.append(
            f"@keyframes {kind}{{{steps}}}.{kind}{{animation:{kind} {self.seconds:g}s step-end infinite}}"
            f".{kind}{{visibility:hidden}}.{kind}.last{{visibility:visible}}"
        )
        for i, outlines in enumerate(frames):
            last = " last" if i == count - 1 else ""
            delay = self.seconds * i / count
            more = f' class="{kind}{last}" style="animation-delay:{delay - self.seconds:.3g}s"'
            self._parts.append(self._path(outlines, stroke=stroke, width=width, more=more))

    def svg(self) -> str:
        """The picture."""
        mine = f".{self.name}"
        light = "".join(f"--{self.name}-{c}:{LIGHT[c]};" for c in sorted(self._colours))
        dark = "".join(f"--{self.name}-{c}:{DARK[c]};" for c in sorted(self._colours))
        style = (
            f"{mine}{{{light}}}@media not print{{html[data-theme=dark] {mine}{{{dark}}}}}"
            f"@media screen and (prefers-color-scheme:dark){{svg:root{{{dark}}}}}"
            + "".join(self._css)
            + f"@media print,(prefers-reduced-motion:reduce){{{mine} *{{animation:none!important}}}}"
        )
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="{self.name}" viewBox="0 0 {WIDTH} {HEIGHT}" '
            f'width="{WIDTH}" height="{HEIGHT}" style="max-width:100%;height:auto" role="img" '
            f'aria-label="{escape(self.title)}"><title>{escape(self.title)}</title><style>{style}</style>'
            f"{''.join(self._parts)}</svg>\n"
        )


def sampled(recording: Recording, count: int = KEYFRAMES) -> tuple[Floats, Floats]:
    """Times (n,) and true poses (n, 3) of a drive, `count` of them, evenly spread."""
    chosen = np.unique(np.linspace(0, len(recording.times) - 1, count).round().astype(int))
    return recording.times[chosen], recording.truth[chosen]


def cells(grid: Any, chosen: NDArray[np.bool_]) -> list[Floats]:
    """The chosen cells of an OccupancyGrid as lines, one for each run of cells in a row."""
    size, at = grid.info.resolution, grid.info.origin.position
    lines = []
    for row, line in enumerate(chosen):
        edges = np.flatnonzero(np.diff(np.concatenate([[0], line.astype(np.int8), [0]])))
        y = at.y + (row + 0.5) * size
        for first, end in edges.reshape(-1, 2):
            lines.append(np.array([[at.x + (first + 0.5) * size, y], [at.x + (end - 0.5) * size, y]]))
    return lines


def wander(graph: Graph, namespace: str = "") -> None:
    """Start a node that drives ahead, and turns away from what is near."""
    node = graph.node("wander", namespace=namespace or "/")
    twist = message_class("geometry_msgs/Twist")
    publisher = node.publisher("cmd_vel", twist, queue_size=1)

    def on_scan(scan: Any) -> None:
        ranges = np.asarray(scan.ranges)
        command = twist()
        if min(ranges[:30].min(), ranges[-30:].min()) > 0.4:
            command.linear.x = 0.2
        else:
            command.angular.z = 0.7
        publisher.publish(command)

    node.subscriber("scan", message_class("sensor_msgs/LaserScan"), on_scan)


def mapping() -> str:
    """A robot that draws a map of a room."""
    with Graph(strict=False) as graph:
        quiet = {"capture_output": True}
        started: Any = rosrun("rosmini_sim", "simulator", "_world:=room", graph=graph, **quiet)
        sim = started.instance()
        roslaunch("turtlebot3_bringup", "turtlebot3_remote.launch", graph=graph, console=quiet, model="burger")
        words = ["__name:=gmapping", "_base_frame:=base_footprint", "_linearUpdate:=0.3", "_angularUpdate:=0.4"]
        words += ["_map_update_interval:=2", "_xmin:=-5", "_ymin:=-5", "_xmax:=5", "_ymax:=5"]
        rosrun("gmapping", "slam_gmapping", *words, graph=graph, **quiet)
        wander(graph)
        recorder = Recorder(graph, sim, layers=True)
        graph.run(50.0)
        recording = recorder.recording()
    film = Film("mapping", "A robot drives through a room and draws a map of it.", (-1.0, -0.9, 3.6, 3.2), 10)
    seen = None
    for time, topic, message in recording.messages:
        if topic != "/map":
            continue
        grid = np.asarray(message.data).reshape(message.info.height, message.info.width)
        walls = grid > 50
        new = walls if seen is None or seen.shape != walls.shape else walls & ~seen
        seen = walls if seen is None or seen.shape != walls.shape else walls | seen
        at = (time - recording.times[0]) / recording.duration
        if lines := cells(message, new):
            film.appear(lines, min(at, 0.97), stroke="ink", width=message.info.resolution * film.scale * 1.6)
    film.robot(*sampled(recording), "blue", 0.12)
    return film.svg()


def drive_to_a_goal() -> Recording:
    """Record a robot that navigates from one room of the house to another."""
    goal = message_class("geometry_msgs/PoseStamped")()
    goal.header.frame_id = "map"
    goal.pose.position.x, goal.pose.position.y, goal.pose.orientation.w = 2.5, 3.0, 1.0
    with Graph(strict=False) as graph:
        roslaunch("rosmini_sim", "navigation.launch", graph=graph, console={"capture_output": True}, world="house")
        graph.run(2.0)
        recorder = Recorder(graph, layers=True)
        click = graph.node("rviz").publisher("move_base_simple/goal", type(goal), latch=True)
        click.publish(goal)
        graph.run(38.0)
        return recorder.recording()


def plan_of(recording: Recording) -> Floats:
    """The first global plan of a drive (n, 2) [m]."""
    paths = (m for _, topic, m in recording.messages if topic == "/move_base/NavfnROS/plan" and len(m.poses) > 9)
    return np.array([[p.pose.position.x, p.pose.position.y] for p in next(paths).poses[::8]])


def goal_by_click(recording: Recording) -> str:
    """A click, a plan, and a robot that follows it."""
    film = Film(
        "goal", "A click sets a goal in a house; a plan appears, and the robot follows it.", (-8.3, -5.3, 8.3, 5.3), 9
    )
    film.world(recording.world)
    film.appear([plan_of(recording)], 0.03, stroke="orange", width=2)
    x, y = plan_of(recording)[-1]
    film.appear(
        [np.array([[x - 0.3, y], [x + 0.3, y]]), np.array([[x, y - 0.3], [x, y + 0.3]])],
        0.0,
        stroke="vermilion",
        width=3,
    )
    film.robot(*sampled(recording), "blue", ROBOT_SIZE, trail=False)
    return film.svg()


def in_rviz(recording: Recording) -> str:
    """The same drive as RViz shows it: a grid, the map, the laser's points, the plan."""
    film = Film("rviz", "RViz shows a robot with its laser scan, its plan and the map.", (-6.0, -1.6, 4.4, 4.9), 9)
    film.background("#303030")
    grid = [np.array([[x, -2.0], [x, 5.0]]) for x in range(-7, 6)] + [
        np.array([[-7.0, y], [6.0, y]]) for y in range(-2, 6)
    ]
    film.path(grid, stroke="#666666", width=0.5)
    film.world(recording.world)
    film.appear([plan_of(recording)], 0.03, stroke="#19ff00", width=1.5)
    chosen = np.linspace(0, len(recording.scans) - 1, 12).round().astype(int)
    dots = []
    for k in chosen:
        pose = recording.truth[
            np.searchsorted(recording.times, recording.scan_times[k]).clip(0, len(recording.times) - 1)
        ]
        ranges = recording.scans[k][::3]
        angles = 2 * np.pi * np.arange(0, recording.scans.shape[1], 3) / recording.scans.shape[1] + pose[2]
        hit = np.isfinite(ranges)
        ends = np.column_stack([pose[0] + ranges * np.cos(angles), pose[1] + ranges * np.sin(angles)])[hit]
        dots.append([np.array([end, end]) for end in ends])
    film.frames(dots, stroke="#ff3030", width=2.5)
    film.robot(*sampled(recording), "#cccccc", ROBOT_SIZE, trail=False)
    return film.svg()


def ten_robots() -> str:
    """Ten robots in a house, each with a program of its own."""
    with Graph(strict=False) as graph:
        words = ("_world:=house", "_robots:=10")
        started: Any = rosrun("rosmini_sim", "simulator", *words, graph=graph, capture_output=True)
        sim = started.instance()
        recorder = Recorder(graph, sim)
        for i in range(10):
            wander(graph, f"/tb3_{i}")
        graph.run(40.0)
        recording = recorder.recording()
    film = Film("ten", "Ten robots drive through a house, each by its own program.", (-8.3, -5.3, 8.3, 5.3), 10)
    film.world(recording.world)
    colours = ("blue", "orange", "green", "purple", "sky", "vermilion")
    for i, robot in enumerate(recording.robots):
        film.robot(*sampled(robot, 25), colours[i % len(colours)], ROBOT_SIZE)
    return film.svg()


def main() -> None:
    """Write all of them and print where."""
    drive = drive_to_a_goal()
    films = {"mapping": mapping(), "goal": goal_by_click(drive), "ten": ten_robots(), "rviz": in_rviz(drive)}
    for name, film in films.items():
        file = FILMS / f"{name}.svg"
        file.write_text(film, encoding="utf-8", newline="\n")
        print(file)


if __name__ == "__main__":
    main()
