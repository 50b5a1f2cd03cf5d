"""`rosmini world`: list the worlds included in rosmini, and check files of worlds, maps and robots."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError
from rosmini.core.verbs import ArgumentParser, Call, Result, Tool

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Mapping

    from rosmini.sim.sdf.document import Note
    from rosmini.sim.world import World

TOOL = Tool("world", "list worlds, and check files of worlds, maps and robots", is_magic=False, group="Run and look")

LONG = 1e6
"""Lengths above this [m] are printed without decimals."""


@dataclass(frozen=True, kw_only=True)
class Worlds(Result):
    """The names and titles of the worlds included in rosmini."""

    titles: dict[str, str]

    def __str__(self) -> str:
        width = max(map(len, self.titles))
        return "\n".join(f"{name:<{width}}  {title}" for name, title in self.titles.items())


def _list_parser() -> ArgumentParser:
    return ArgumentParser(
        "rosmini world list", "List the worlds that rosmini brings.", epilog="for example: rosmini world list"
    )


@TOOL.verb("list the worlds that rosmini brings", name="list", parser=_list_parser)
def list_(_given: argparse.Namespace, _call: Call) -> Worlds:
    """Return the worlds included in rosmini."""
    from rosmini.sim.worlds import names, title

    return Worlds(titles={name: title(name) for name in names()})


@dataclass(frozen=True)
class FileCheck:
    """The contents of a readable file, the omissions, and the notes about it."""

    file: str
    what: str
    notes: tuple[str, ...] = ()
    left_out: Mapping[str, int] = field(default_factory=dict)
    """Short descriptions of what rosmini leaves out, with their counts."""

    def __str__(self) -> str:
        missing = [each if count == 1 else f"{each} ({count} times)" for each, count in self.left_out.items()]
        verdict = f"read without {_listed(missing)}" if missing else "sound"
        return "\n".join([f"{self.file}: {verdict}: {self.what}", *(f"  {note}" for note in self.notes)])


@dataclass(frozen=True, kw_only=True)
class Checked(Result):
    """The readable files; the errors of the others are complaints."""

    sound: tuple[FileCheck, ...]

    def __str__(self) -> str:
        return "\n".join(map(str, self.sound))


def _check_parser() -> ArgumentParser:
    parser = ArgumentParser(
        "rosmini world check",
        "Check files: Gazebo worlds and models (SDF), Stage worlds, ROS maps (YAML). What a file is, is read from its "
        "contents. The exit status is 1 if something is wrong with one of them; notes are no errors.",
        epilog="for example: rosmini world check my.world map.yaml",
    )
    parser.add_argument("files", nargs="+", metavar="FILE", help="a file, or the name of a world that rosmini brings")
    return parser


@TOOL.verb("check files, and say what is wrong with them, where, and what would be left out", parser=_check_parser)
def check(given: argparse.Namespace, _call: Call) -> Checked:
    """Check files."""
    sound: list[FileCheck] = []
    complaints: list[str] = []
    for file in given.files:
        try:
            sound.append(_checked(file))
        except (RosminiError, OSError) as error:
            complaints.append(_placed(file, str(error)))
    return Checked(sound=tuple(sound), complaints=tuple(complaints), status=1 if complaints else 0)


def _checked(file: str) -> FileCheck:
    """Check one file. Raises the errors of its reader."""
    from rosmini.sim.worlds import kind_of, names, source, world

    path: Path | None
    if file in names() and not Path(file).exists():
        path = source(file)
        if path is None:
            return FileCheck(file, f"made in Python: {_measures(world(file))}")
    else:
        path = _resolved(file)
    checks: dict[str, Callable[[Path], FileCheck]] = {
        "sdf": _sdf, "stage": _stage, "map": _map, "urdf": _sdf, "xml": _sdf,
    }  # fmt: skip
    return checks[kind_of(path)](path)


def _resolved(file: str) -> Path:
    if file.startswith("package://"):
        from rosmini.core.packages import PackageIndex

        return PackageIndex().resolve(file)
    return Path(file)


def _placed(file: str, message: str) -> str:
    """Return a message that begins with the file, unless it contains the file already."""
    return f"error: {message}" if Path(file).name in message else f"error: {file}: {message}"


def _sdf(path: Path) -> FileCheck:
    from rosmini.sim.sdf import converted, load, to_obstacles

    document = load(path)
    said = []
    notes = [_noted(note) for note in document.notes]
    left_out = Counter(note.left_out for note in document.notes if note.left_out)
    for each in document.worlds:
        made, more = converted(each)
        notes += [_noted(note) for note in more]
        left_out.update(note.left_out for note in more if note.left_out)
        said.append(f"the world {each.name!r}: {_measures(made)}")
        notes += _occupied(made, f"{each.path}:{each.line}")
    for model in document.models:
        solid = to_obstacles(model)
        said.append(f"the model {model.name!r}: {_count(len(model.links), 'link')}, {_count(len(solid), 'obstacle')}")
    said += [f"the actor {actor.name!r}" for actor in document.actors]
    what = f"SDF {document.version}: {'; '.join(said) or 'nothing in it'}"
    return FileCheck(str(path), what, tuple(notes), left_out)


def _noted(note: Note) -> str:
    return f"warning: {note}" if note.warning else str(note)


def _stage(path: Path) -> FileCheck:
    from rosmini.sim.stage.world_file import load

    made = load(path)
    return FileCheck(str(path), f"Stage: {_measures(made.world)}", made.notes, made.left_out)


def _map(path: Path) -> FileCheck:
    from rosmini.core.maps import load_map

    grid = load_map(path)
    height, width = grid.occupancy.shape
    occupied, free = (100 * float(mask.mean()) for mask in (grid.occupied, grid.free))
    size = f"{width} x {height} cells of {grid.resolution:g} m"
    return FileCheck(str(path), f"map: {size}, {occupied:.1f}% occupied, {free:.1f}% free")


def _measures(world: World) -> str:
    x0, y0, x1, y1 = world.bounds
    walls = [_count(len(world.walls), "wall")] if len(world.walls) else []
    moving = sum(each.motion is not None for each in world.obstacles)
    moves = [f"{moving} of them moving"] if moving else []
    things = [_count(len(world.obstacles), "obstacle"), *moves]
    return ", ".join(
        [*walls, *things, _count(len(world.starts), "start"), f"{_metres(x1 - x0)} m by {_metres(y1 - y0)} m"]
    )


def _metres(length: float) -> str:
    return f"{length:.1f}" if length < LONG else f"{length:.3g}"


def _occupied(world: World, place: str) -> list[str]:
    """Return notes about starts at which a small robot has no room."""
    found = []
    for i, start in enumerate(world.starts, 1):
        blocked = world.blocked(start, 0.1, height=0.2)
        if blocked:
            x, y, _ = start
            found.append(f"{place}: start {i} at ({x:.2f}, {y:.2f}) is not free: {blocked} is there")
    return found


def _listed(words: list[str]) -> str:
    return f"{', '.join(words[:-1])} and {words[-1]}" if len(words) > 1 else words[0]


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
