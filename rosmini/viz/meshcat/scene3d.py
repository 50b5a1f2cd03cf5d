"""A scene in three dimensions, built through meshcat's own API and recorded as commands.

Frames follow ROS: x forward, y to the left, z up, metres (REP 103). The scene is moved so that the camera's target is
at meshcat's origin, around which its controls rotate.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.polygons import simplified_indices
from rosmini.core.geometry.poses import compose, inverse
from rosmini.core.geometry.products import inverse_matrix, matrix_product
from rosmini.sim.models import LidarModel, RobotModel
from rosmini.sim.sensors.scene import trapezia
from rosmini.sim.shapes import Cylinder, Simple, Sphere, outline_at, simple_parts
from rosmini.sim.shapes import Part as SimplePart
from rosmini.sim.world import Obstacle, Pose, World
from rosmini.viz import style
from rosmini.viz.replay.packing import ANGLE, TIME, pack_columns
from rosmini.viz.rounding import snap

from . import burger
from .command_recorder import Recorder, meshcat
from .links import link_parts, link_surfaces, turtlebot3
from .solids import Ball, Facets, LinkPart, Part, Prism, Rod, Solid, mesh, rounded

Floats = NDArray[np.float64]
Colour = tuple[float, float, float]

URDF_MODELS = ("waffle", "waffle_pi")
"""Models that are drawn from their URDF. The Burger has its own drawing, a tenth of the size."""
OMITTED_COLOURS = ("#181c20",)
"""Colours left out of these drawings in a world: holes in plates, a quarter of the bytes and barely visible there."""
SIDES = (("left", 1), ("right", -1))
"""The wheels, and the sign of their y axis that points outwards."""
ROBOT = "robots/robot"
"""The path of the first robot."""
WALL_THICKNESS = 0.03
"""Thickness of a wall that a map gives as a line [m]."""
MANY_WALLS = 400
"""Above this number, walls are sheets without a top: a traced map has thousands of walls."""
TRAIL_WIDTH = 0.016
"""Width of a trail [m]."""
POINT_OFFSET = 0.012
"""Distance by which points of a laser without noise are moved towards it, so that they stay visible [m]."""

WALL, GREY, GROUND, GRID = "#c4ccd4", "#98a3ad", "#e8ecf0", "#b9c2ca"
DARK_GROUND, DARK_GRID, DARK_WALL = "#2d353e", "#505c68", "#77828d"


@dataclass(frozen=True)
class Camera:
    """A camera that looks at a point from a `distance` [m], an `azimuth` and an `elevation` [deg].

    At azimuth 0 the camera is on the side of x, at 90 on the side of y.
    """

    target: tuple[float, float, float]
    distance: float
    azimuth: float = -50.0
    elevation: float = 32.0
    field_of_view: float = 38.0
    """Vertical field of view [deg]."""

    @property
    def position(self) -> Floats:
        """The position in the world (3,)."""
        azimuth, elevation = math.radians(self.azimuth), math.radians(self.elevation)
        flat = self.distance * math.cos(elevation)
        return np.array(
            [
                self.target[0] + flat * math.cos(azimuth),
                self.target[1] + flat * math.sin(azimuth),
                self.target[2] + self.distance * math.sin(elevation),
            ]
        )


@dataclass(frozen=True)
class Trail:
    """A line on the ground."""

    name: str
    points: Floats
    """(n, 2) [m]"""
    colour: str


@dataclass(frozen=True)
class Motion:
    """The change of a property of the object at a path: values (n, k) [m or rad] at times (n,) [s]."""

    path: str
    name: str
    times: Floats
    values: Floats

    @property
    def data(self) -> list[str]:
        """The data for the viewer's script: path, property and packed columns, to 0.1 mm and 0.1 mrad."""
        rows = np.column_stack([self.times, self.values])
        return [self.path, self.name, pack_columns(rows, TIME, *[ANGLE] * self.values.shape[1])]


@dataclass
class Scene3D:
    """Objects in a world, each under a path of meshcat's tree; `visualizer` accepts more through meshcat's API."""

    camera: Camera
    parts: list[Part] = field(default_factory=list)
    surfaces: list[LinkPart] = field(default_factory=list)
    """Surfaces of robots that are drawn from their description."""
    trails: list[Trail] = field(default_factory=list)
    scans: list[Floats] = field(default_factory=list)
    """Points (n, 3) in the world that lasers saw."""
    bounds: tuple[float, float, float, float] = (-1.0, -1.0, 1.0, 1.0)
    """The area covered by the ground: x and y of its lower left, then of its upper right corner."""
    duration: float = 0.0
    """Duration of the animation [s]; 0 if nothing moves."""
    motions: list[Motion] = field(default_factory=list)
    copies: list[tuple[str, str]] = field(default_factory=list)
    """Paths of objects, each with the path of a copy: the viewer stores one geometry for all copies."""

    def __post_init__(self) -> None:
        self._shared: dict[tuple[str, bytes, bytes], str] = {}
        self.recorder = Recorder()
        self.visualizer: Any = meshcat().Visualizer(window=self.recorder)
        self.nodes: dict[str, Floats] = {"": np.eye(4)}
        self._stage()

    @property
    def commands(self) -> list[bytes]:
        """The commands for meshcat's viewer, in order."""
        return self.recorder.commands

    def _stage(self) -> None:
        """Set up the camera and the lights, and hide meshcat's own grid, axes and background."""
        scene, camera = self.visualizer, self.camera
        for name in ("/Grid", "/Axes", "/Background"):
            scene[name].set_property("visible", False)
        lens = meshcat().geometry.PerspectiveCamera(fov=camera.field_of_view, near=0.02, far=200.0)
        scene["/Cameras/default/rotated"].set_object(lens)
        x, y, z = (camera.position - camera.target).tolist()
        # meshcat rotates the frame of its camera by 90 degrees about x.
        scene["/Cameras/default/rotated/<object>"].set_property("position", [x, z, -y])
        reach = max(2.5, camera.distance)
        spot = scene["/Lights/SpotLight/<object>"]
        spot.set_property("position", [0.45 * reach, -0.75 * reach, 1.6 * reach])
        for name, value in (("intensity", 0.5), ("penumbra", 0.5), ("angle", 0.75)):
            spot.set_property(name, value)
        self.recorder.set_property("/Lights/SpotLight/<object>", "castShadow", value=True)
        scene["/Lights/SpotLight"].set_property("visible", True)
        for name in ("PointLightNegativeX", "PointLightPositiveX"):
            scene[f"/Lights/{name}/<object>"].set_property("intensity", 0.06)
        scene["/Lights/AmbientLight/<object>"].set_property("intensity", 0.52)
        scene["/Lights/FillLight/<object>"].set_property("intensity", 0.2)
        shift = np.eye(4)
        shift[:3, 3] = -np.array(camera.target)
        scene.set_transform(rounded(shift))

    def place(self, node: str, transform: Floats) -> None:
        """Give a node a transform (4, 4) relative to its parent."""
        self.nodes[node] = transform
        self.visualizer[node].set_transform(rounded(transform))

    def add(self, part: Part) -> None:
        """Add a part to its node."""
        self.parts.append(part)
        geometry, path = meshcat().geometry, self.visualizer[f"{part.node}/{part.name}".removeprefix("/")]
        material = geometry.MeshPhongMaterial(
            color=int(part.colour[1:], 16), shininess=20 + 60 * part.shine, specular=int(90 * part.shine) * 0x010101
        )
        flat = [solid for solid in part.solids if isinstance(solid, Prism | Facets)]
        if flat:
            path.set_object(geometry.TriangularMeshGeometry(*mesh(flat)), material)
        for i, solid in enumerate(solid for solid in part.solids if not isinstance(solid, Prism | Facets)):
            place = np.eye(4)
            place[:3, 3] = solid.centre
            if not isinstance(solid, Rod):
                path[str(i)].set_object(geometry.Sphere(solid.radius), material)
            else:
                rod = geometry.Cylinder(solid.length, solid.radius)
                path[str(i)].set_object(rod, material)
                if solid.axis == "z":
                    place[:3, :3] = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
            path[str(i)].set_transform(rounded(place))

    def add_surface(self, part: LinkPart, *, shared: bool = False) -> None:
        """Add a surface to its node; if an equal `shared` surface exists, only record it as a copy."""
        self.surfaces.append(part)
        path, vertices = f"{part.node}/{part.name}", rounded(part.surface.vertices)
        if shared:
            known = (part.colour, vertices.tobytes(), part.surface.faces.tobytes())
            first = self._shared.setdefault(known, path)
            if first != path:
                self.copies.append((f"/meshcat/{first}", f"/meshcat/{path}"))
                return
        geometry = meshcat().geometry
        material = geometry.MeshPhongMaterial(color=int(part.colour[1:], 16), shininess=26, specular=0x0E0E0E)
        triangles = geometry.TriangularMeshGeometry(vertices, part.surface.faces)
        self.visualizer[path].set_object(triangles, material)

    def add_ground(self, bounds: tuple[float, float, float, float]) -> None:
        """Add a floor that extends half a metre beyond `bounds`, with a line every metre."""
        x0, y0, x1, y1 = self.bounds = (
            math.floor(bounds[0] - 0.5), math.floor(bounds[1] - 0.5),
            math.ceil(bounds[2] + 0.5), math.ceil(bounds[3] + 0.5),
        )  # fmt: skip
        geometry = meshcat().geometry
        corners = np.array([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)])
        floor = geometry.TriangularMeshGeometry(corners, [(0, 1, 2), (0, 2, 3)])
        self.visualizer["ground"].set_object(floor, _matt(GROUND))
        # The viewer would draw lines one pixel wide, near and far, so they are thin strips.
        width = 0.0022 * self.camera.distance
        strips = [ribbon(np.array(line, dtype=float), width, 0.002) for line in grid(self.bounds)]
        vertices = np.vstack([corners for corners, _ in strips])
        faces = np.vstack([among + 4 * i for i, (_, among) in enumerate(strips)])
        lines = geometry.TriangularMeshGeometry(vertices, faces)
        self.visualizer["grid"].set_object(lines, geometry.MeshBasicMaterial(color=int(GRID[1:], 16)))

    def add_world(self, world: World, *, bounds: tuple[float, float, float, float] | None = None) -> None:
        """Add walls and obstacles, and ground under them or within `bounds`."""
        self.add_ground(bounds or world.bounds)
        if len(world.walls):
            self._add_walls(world)
        for obstacle in world.obstacles:
            self.add_obstacle(obstacle)

    def _add_walls(self, world: World) -> None:
        if world.solid and len(world.walls) <= MANY_WALLS:
            tops = trapezia(world.walls, world.wall_height)
            self.add(Part("", "blocks", WALL, (Facets(tuple(tops)),)))
        if len(world.walls) <= MANY_WALLS:
            walls = tuple(Prism(_slab(*wall), 0.0, world.wall_height) for wall in world.walls)
            self.add(Part("", "walls", WALL, walls))
            return
        ends = world.walls.reshape(-1, 2)
        low, high = (np.column_stack([ends, np.full(len(ends), z)]) for z in (0.0, world.wall_height))
        vertices = np.stack([low, high], axis=1).reshape(-1, 3)
        first = 4 * np.arange(len(world.walls))[:, None]
        faces = np.vstack([first + np.array(corners) for corners in ((0, 2, 3), (0, 3, 1))])
        sheets = meshcat().geometry.TriangularMeshGeometry(rounded(vertices), faces)
        self.visualizer["walls"].set_object(sheets, _matt(WALL))

    def add_obstacle(self, obstacle: Obstacle) -> None:
        """Add an obstacle where it is."""
        node = obstacle_node(obstacle.name)
        while node in self.nodes:  # names may occur twice
            node += "'"
        self.place(node, planar(obstacle.pose))
        bottom, top = obstacle.bottom, obstacle.height
        solids = tuple(_upright(shape, pose, bottom, top) for shape, pose in simple_parts(obstacle.shape))
        self.add(Part(node, "solid", colour_of(obstacle.colour), solids, shine=0.1))

    def add_robot(self, model: RobotModel, pose: Pose, name: str = ROBOT) -> None:
        """Add a robot with its frame base_footprint at `pose`; its wheels are nodes below it."""
        self.place(name, planar(pose))
        kind = model.name.removeprefix("turtlebot3_")  # the names in Gazebo have it
        if kind in URDF_MODELS:
            self._add_described(replace(model, name=kind), name)
        elif kind == "burger":
            for part in burger.body(model, name):
                self.add(part)
            for side, outwards in SIDES:
                node = self._place_hub(model, name, side, outwards)
                for part in burger.wheel(model, node, outwards):
                    self.add(part)
        else:
            for i, seen in enumerate(model.solid):
                self.add(self._solid(seen, name, f"part{i}", model.height))

    def _place_hub(self, model: RobotModel, name: str, side: str, outwards: int) -> str:
        """Place the node of a wheel, which turns about its y axis, and return its path."""
        hub = np.eye(4)
        hub[:3, 3] = (0.0, outwards * model.wheel_separation / 2, model.wheel_radius)
        self.place(f"{name}/wheel_{side}", hub)
        return f"{name}/wheel_{side}"

    def _add_described(self, model: RobotModel, name: str) -> None:
        """Add a TurtleBot3 from its URDF; everything that turns is below the nodes of its wheels."""
        robot = turtlebot3(model.name)
        for side, outwards in SIDES:
            self._place_hub(model, name, side, outwards)
        for link, at in robot.transforms().items():
            surfaces = link_surfaces(robot, link, without=OMITTED_COLOURS)
            if not surfaces:
                continue
            above = f"{name}/{link.removesuffix('_link')}" if link.startswith("wheel_") else name
            self.place(
                f"{above}/{link}", matrix_product(inverse_matrix(self.nodes[above]), at) if above != name else at
            )
            for part in link_parts(f"{above}/{link}", surfaces):
                self.add_surface(part)

    def _solid(self, part: SimplePart, node: str, name: str, height: float) -> Part:
        """Return a part of a robot of which only the outlines are known."""
        bottom, top = part.bottom, min(part.top, height)
        solids = tuple(_upright(shape, pose, bottom, top) for shape, pose in simple_parts(part.shape, part.pose))
        return Part(node, name, colour_of(part.colour), solids, shine=0.2)

    def add_scan(self, model: RobotModel, ranges: Floats, pose: Pose | Floats | None = None, name: str = ROBOT) -> None:
        """Add the scan of a robot that was added before: ranges (beams,) [m], not finite where nothing was hit.

        It was taken at `pose`, or each beam at one of several poses (beams, 3); by default at the robot's pose.
        """
        points = scan_points(ranges, model.laser)
        mount = np.eye(4)
        mount[:3, 3] = model.laser.mount
        if model.laser.yaw:
            mount = matrix_product(mount, planar((0.0, 0.0, model.laser.yaw)))
        if pose is not None:
            poses = np.atleast_2d(pose)
            lasers = compose(poses, (*model.laser.mount[:2], model.laser.yaw))
            ends = compose(
                compose(inverse(lasers[:1]), lasers), np.column_stack([points[:, :2], np.zeros(len(points))])
            )
            points = rounded(np.column_stack([ends[:, :2], points[:, 2]]))
            mount = matrix_product(matrix_product(inverse_matrix(self.nodes[name]), planar(poses[0])), mount)
        self.place(f"{name}/scan", mount)
        place = self.transform(f"{name}/scan")
        self.scans.append(matrix_product(points[np.isfinite(ranges)], place[:3, :3].T) + place[:3, 3])
        geometry = meshcat().geometry
        colours = np.tile(np.array([_rgb(style.LIGHT["vermilion"])]), (len(points), 1))
        # A beam without a hit has its point far below the ground, so that the number of points is constant.
        self.visualizer[f"{name}/scan"].set_object(
            geometry.PointCloud(points.T.astype(np.float32), colours.T.astype(np.float32), size=0.022)
        )
        self.recorder.set_property(f"/meshcat/{name}/scan/<object>", "frustumCulled", value=False)
        self.recorder.set_property(f"/meshcat/{name}/scan/<object>", "castShadow", value=False)

    def add_trail(self, name: str, points: Floats, colour: str, height: float = 0.004) -> None:
        """Add a line (n, 2) on the ground, in a colour of the palette."""
        points = simplified(np.asarray(points, dtype=float))
        if len(points) < 2:
            return
        self.trails.append(Trail(name, points, colour))
        vertices, faces = ribbon(points, TRAIL_WIDTH, height)
        strip = meshcat().geometry.TriangularMeshGeometry(vertices, faces)
        material = meshcat().geometry.MeshBasicMaterial(color=int(style.LIGHT[colour][1:], 16))
        self.visualizer[f"trails/{name}"].set_object(strip, material)

    def animate(self, times: Floats, tracks: Iterable[tuple[str, str, Floats]]) -> None:
        """Animate nodes: tracks are (node, property, values), values (n,) or (n, k) at `times` (n,), linear in between.

        Properties are those of three.js: `position`, `quaternion`, `rotation[z]` ... Redundant samples are left out.
        """
        for node, name, values in tracks:
            table = values.reshape(len(times), -1)
            kept = keyframes(times, table, 0.001 if values.ndim == 2 else 0.01)
            self.motions.append(Motion(f"/meshcat/{node}", name, times[kept], table[kept]))
        self.duration = float(snap(times[-1]))

    def transform(self, node: str) -> Floats:
        """Return the transform of a node in the world (4, 4)."""
        result: Floats = np.eye(4)
        names = node.split("/")
        for i in range(1, len(names) + 1):
            result = matrix_product(result, self.nodes.get("/".join(names[:i]), np.eye(4)))
        return result

    @property
    def themes(self) -> dict[str, dict[str, Sequence[float]]]:
        """Objects whose colour depends on the page's theme: their paths and colours, for light and for dark pages."""
        paths = {"/meshcat/ground": (GROUND, DARK_GROUND), "/meshcat/grid": (GRID, DARK_GRID)}
        walls = (part for part in self.parts if part.colour == WALL)
        paths |= {f"/meshcat/{part.node}/{part.name}".replace("//", "/"): (WALL, DARK_WALL) for part in walls}
        for trail in self.trails:
            paths[f"/meshcat/trails/{trail.name}"] = (style.LIGHT[trail.colour], style.DARK[trail.colour])
        return {
            name: {path: [*(round(c, 4) for c in _rgb(colours[i])), 1.0] for path, colours in paths.items()}
            for i, name in enumerate(("light", "dark"))
        }


def planar(pose: Pose) -> Floats:
    """Return the transform (4, 4) of a pose on the ground."""
    x, y, theta = pose
    c, s = math.cos(theta), math.sin(theta)
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, 0], [0, 0, 0, 1.0]])


def obstacle_node(name: str) -> str:
    """Return the path of an obstacle in the scene."""
    return "obstacles/" + name.replace("/", " ")


def _upright(shape: Simple, pose: Pose, bottom: float, top: float) -> Solid:
    """Return a shape as an upright solid."""
    if isinstance(shape, Sphere):
        return Ball((pose[0], pose[1], bottom + shape.radius), shape.radius)
    if isinstance(shape, Cylinder):
        return Rod((pose[0], pose[1], (bottom + top) / 2), shape.radius, top - bottom)
    return Prism(outline_at(shape, pose), bottom, top)


def colour_of(name: str) -> str:
    """Return the colour of an obstacle."""
    return name if name.startswith("#") else {"wall": WALL, "grey": GREY}.get(name) or style.LIGHT[name]


def scan_points(ranges: Floats, lidar: LidarModel) -> Floats:
    """Return the ends of beams (beams, 3), seen from the laser; 100 m below it for beams without a hit.

    A laser with a full circle may give fewer ranges than it has beams, evenly spread. The points of a laser without
    noise would lie in the surfaces, where they cannot be seen, so they are drawn slightly nearer.
    """
    places = np.arange(len(ranges))
    step = 2 * math.pi * places / len(ranges) if lidar.angle_max is None else lidar.increment * places
    angles = lidar.angle_min + step
    hit = np.isfinite(ranges)
    reach = np.where(hit, ranges - (0.0 if lidar.noise else POINT_OFFSET), 0.0)
    return rounded(np.column_stack([reach * np.cos(angles), reach * np.sin(angles), np.where(hit, 0.0, -100.0)]))


def grid(bounds: tuple[float, float, float, float]) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """Return a line every metre in both directions; on large grounds every five metres or more."""
    x0, y0, x1, y1 = bounds
    step = next(s for s in (1, 5, 10, 50, 100, 1000) if max(x1 - x0, y1 - y0) / s <= 60 or s == 1000)
    xs = np.arange(math.ceil(x0 / step) * step, x1 + step / 2, step).tolist()
    ys = np.arange(math.ceil(y0 / step) * step, y1 + step / 2, step).tolist()
    return [((x, y0), (x, y1)) for x in xs] + [((x0, y), (x1, y)) for y in ys]


def ribbon(points: Floats, width: float, height: float) -> tuple[Floats, NDArray[np.int64]]:
    """Return a strip along a line (n, 2): vertices (2n, 3) and triangles (m, 3) facing up, of constant width."""
    steps = np.diff(points, axis=0)
    steps /= np.hypot(*steps.T)[:, None] + 1e-12
    normals = np.column_stack([-steps[:, 1], steps[:, 0]])
    joint = np.vstack([normals[:1], normals[:-1] + normals[1:], normals[-1:]])
    joint[1:-1] /= 1e-12 + (joint[1:-1] * normals[1:]).sum(axis=1)[:, None]
    length = np.hypot(*joint.T)[:, None]
    joint *= np.minimum(1.0, 2.0 / (length + 1e-12)) * width / 2
    sides = np.stack([points + joint, points - joint], axis=1).reshape(-1, 2)
    first = 2 * np.arange(len(points) - 1)[:, None]
    faces = np.vstack([first + np.array(corners) for corners in ((0, 1, 2), (1, 3, 2))])
    return rounded(np.column_stack([sides, np.full(len(sides), height)])), faces


def keyframes(times: Floats, values: Floats, tolerance: float) -> list[int]:
    """Return the samples (n, k) to keep so that lines between them are within `tolerance` of all others."""

    def gaps(first: int, last: int) -> Floats:
        part = (times[first + 1 : last] - times[first]) / (times[last] - times[first])
        line = values[first] + part[:, None] * (values[last] - values[first])
        # snapped, so that of two samples at the same distance every machine takes the same one
        return snap(np.abs(values[first + 1 : last] - line).max(axis=1), 1e-7)

    return simplified_indices([0, len(times) - 1], gaps, tolerance)


def simplified(points: Floats, tolerance: float = 0.002) -> Floats:
    """Return the vertices of a line (n, 2) without those that change it by less than `tolerance` in x and in y."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    distance = np.concatenate([[0.0], np.cumsum(np.where(steps > 1e-9, steps, 0.0))])
    moved = np.concatenate([[True], np.diff(distance) > 0])
    distance, points = distance[moved], points[moved]
    return points[keyframes(distance, points, tolerance)]


def _slab(x1: float, y1: float, x2: float, y2: float) -> Floats:
    """Return the outline of a wall along a segment."""
    a, b = np.array([x1, y1]), np.array([x2, y2])
    along = (b - a) / (math.hypot(x2 - x1, y2 - y1) or 1.0) * WALL_THICKNESS / 2
    aside = np.array([-along[1], along[0]])
    return np.array([a - along - aside, b + along - aside, b + along + aside, a - along + aside])


def _rgb(colour: str) -> Colour:
    return (int(colour[1:3], 16) / 255, int(colour[3:5], 16) / 255, int(colour[5:7], 16) / 255)


def _matt(colour: str) -> Any:
    # Not a Lambert material: the viewer computes its light only at vertices, and the ground has four.
    return meshcat().geometry.MeshPhongMaterial(color=int(colour[1:], 16), shininess=0, specular=0)
