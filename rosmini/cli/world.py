"""`rosmini world`: which worlds there are, and whether files of worlds, maps and robots are sound."""

from __future__ import annotations

import argparse
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.errors import RosminiError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.sim.sdf.document import Note
    from rosmini.sim.world import World

LONG = 1e6
"""From so many metres on decimals say nothing."""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `world` to the parser of `rosmini`."""
    summary = "list the worlds that rosmini brings, and check files of worlds, maps and robots"
    parser = subparsers.add_parser("world", help=summary, description=summary)
    verbs = parser.add_subparsers(dest="verb", metavar="VERB", required=True)
    verbs.add_parser("list", help="list the worlds that rosmini brings")
    check = verbs.add_parser(
        "check",
        help="check files, and say what is wrong with them, where, and what would be left out",
        description="Check files: Gazebo worlds and models (SDF), Stage worlds, ROS maps (YAML) and robots (URDF). What a file is, is told from what "
        "stands in it. The exit status is 1 if something is wrong with one of them; notes are no errors.",
    )
    check.add_argument(
        "files", nargs="+", metavar="FILE", help="a file, or the name of a world that rosmini brings"
    )
    check.add_argument(
        "--unconfined", action="store_true",
        help="let expressions of xacro files do whatever Python can; only for files that you trust",
    )  # fmt: skip
    return parser


def main(args: argparse.Namespace) -> int:
    """Do what the verb says; the exit status."""
    if args.verb == "list":
        return _list()
    sound = [_check(file, confined=not args.unconfined) for file in args.files]
    return 0 if all(sound) else 1


def _list() -> int:
    from rosmini.sim.worlds import names, title

    width = max(map(len, names()))
    for name in names():
        print(f"{name:<{width}}  {title(name)}")
    return 0


def _check(file: str, *, confined: bool) -> bool:
    """Check one file and print what there is to say; whether it is sound."""
    from rosmini.sim.worlds import kind_of, names, source, world

    try:
        if file in names() and not Path(file).exists():
            path = source(file)
            if path is None:
                print(f"{file}: sound: made in Python: {_measures(world(file))}")
                return True
        else:
            path = _resolved(file)
        checks: dict[str, Callable[[Path], tuple[str, list[str]]]] = {
            "sdf": _sdf, "stage": _stage, "map": _map, "urdf": partial(_urdf, confined=confined), "xml": _sdf,
        }  # fmt: skip
        what, notes = checks[kind_of(path)](path)
    except (RosminiError, OSError) as error:
        print(_placed(file, str(error)), file=sys.stderr)
        return False
    print(f"{path}: sound: {what}")
    for note in notes:
        print(f"  {note}")
    return True


def _resolved(file: str) -> Path:
    if file.startswith("package://"):
        from rosmini.packages import PackageIndex

        return PackageIndex().resolve(file)
    return Path(file)


def _placed(file: str, message: str) -> str:
    """A message with the file in front, unless it is there already."""
    return f"error: {message}" if Path(file).name in message else f"error: {file}: {message}"


def _sdf(path: Path) -> tuple[str, list[str]]:
    from rosmini.sim.sdf import converted, load, to_obstacles

    document = load(path)
    said = []
    notes = [_noted(note) for note in document.notes]
    for each in document.worlds:
        made, more = converted(each)
        notes += [_noted(note) for note in more]
        said.append(f"the world {each.name!r}: {_measures(made)}")
        notes += _occupied(made, f"{each.path}:{each.line}")
    for model in document.models:
        solid = to_obstacles(model)
        said.append(
            f"the model {model.name!r}: {_count(len(model.links), 'link')}, {_count(len(solid), 'obstacle')}"
        )
    said += [f"the actor {actor.name!r}" for actor in document.actors]
    return f"SDF {document.version}: {'; '.join(said) or 'nothing in it'}", notes


def _noted(note: Note) -> str:
    return f"warning: {note}" if note.warning else str(note)


def _stage(path: Path) -> tuple[str, list[str]]:
    from rosmini.sim.stage import load

    made = load(path)
    return f"Stage: {_measures(made.world)}", [str(note) for note in getattr(made, "notes", ())]


def _map(path: Path) -> tuple[str, list[str]]:
    from rosmini.navigation.map_server import load_map

    grid = load_map(path)
    height, width = grid.occupancy.shape
    occupied, free = (100 * float(mask.mean()) for mask in (grid.occupied, grid.free))
    size = f"{width} x {height} cells of {grid.resolution:g} m"
    return f"map: {size}, {occupied:.1f} % occupied, {free:.1f} % free", []


def _urdf(path: Path, *, confined: bool) -> tuple[str, list[str]]:
    from rosmini.markup import parse_file
    from rosmini.urdf import UrdfError, load

    written = parse_file(path, UrdfError)
    if path.suffix == ".xacro" and not written.get("name"):  # no robot, but what others include
        from rosmini.urdf.xacro import expand

        expand(path, {}, confined=confined)
        macros = sum(each.tag == "xacro:macro" for each in written.walk())
        return f"xacro: a part of a robot, with {_count(macros, 'macro')}, for others to include", []
    robot = load(path, confined=confined)
    said = f"URDF: the robot {robot.name!r}: {_count(len(robot.links), 'link')}, {_count(len(robot.joints), 'joint')}"
    return said, [str(note) for note in robot.notes]


def _measures(world: World) -> str:
    x0, y0, x1, y1 = world.bounds
    walls = [_count(len(world.walls), "wall")] if len(world.walls) else []
    moving = sum(each.motion is not None for each in world.obstacles)
    moves = [f"{moving} of them moving"] if moving else []
    things = [_count(len(world.obstacles), "obstacle"), *moves]
    return ", ".join(
        [
            *walls,
            *things,
            _count(len(world.starts), "start"),
            f"{_metres(x1 - x0)} m by {_metres(y1 - y0)} m",
        ]
    )


def _metres(length: float) -> str:
    return f"{length:.1f}" if length < LONG else f"{length:.3g}"


def _occupied(world: World, place: str) -> list[str]:
    """Starts at which a small robot has no room."""
    found = []
    for i, start in enumerate(world.starts, 1):
        blocked = world.blocked(start, 0.1, height=0.2)
        if blocked:
            x, y, _ = start
            found.append(f"{place}: start {i} at ({x:.2f}, {y:.2f}) is not free: {blocked} is there")
    return found


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
