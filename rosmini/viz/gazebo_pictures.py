"""A running Gazebo world from above: robots are named and coloured, other models are drawn as objects."""

from __future__ import annotations

from rosmini.sim.gazebo.snapshot import Snapshot
from rosmini.viz.figures import WIDTH
from rosmini.viz.rounding import fixed
from rosmini.viz.view import Picture
from rosmini.viz.world_pictures import HEIGHT, Other, Scene, contents, pose_text

MAX_NAMED = 12
"""Maximum number of models that are named."""


def gazebo_picture(
    snapshot: Snapshot, *, title: str | None = None, size: tuple[float, float] = (WIDTH, HEIGHT)
) -> Picture:
    """Draw a Gazebo world from above, in metres, x to the right and y up. Its first robot is blue.

    Args:
        snapshot: the snapshot of a server or a client.
        title: a caption under the picture, and the first words of its text form.
        size: the largest width and height [CSS px].

    """
    return _Scene(snapshot).picture(title, size)


class _Scene(Scene):
    """The contents of a Gazebo world."""

    def __init__(self, snapshot: Snapshot) -> None:
        super().__init__(snapshot.world(robots=False))
        self.snapshot = snapshot
        self.alone_too = True
        first, *others = snapshot.robots or [None]
        if first is not None:
            self.robot, self.model, self.name = first.pose, first.model, first.name
        self.others = [Other(each.name, each.model, each.pose) for each in others if each is not None]

    def text(self, title: str | None) -> str:
        """The time in the world, and the position of everything."""
        head = [f"{title or self.snapshot.title}: {time_text(self.snapshot)}", contents(self.world)]
        own = super().text(title).splitlines()[1:]
        return "\n".join([*head, *own, *pose_lines(self.snapshot)])

    def alt(self) -> str:
        """The same as sentences."""
        said = super().alt()
        return f"{said} It is {time_text(self.snapshot)}."


def time_text(snapshot: Snapshot) -> str:
    """Return the time in the world, and whether it is paused."""
    return f"{fixed(snapshot.time, 2)} s{', paused' * snapshot.paused}"


def pose_lines(snapshot: Snapshot) -> list[str]:
    """Return a line for each movable model, and one for the static ones."""
    lines = [f"{model.name}: pose {pose_text(model.place)}" for model in snapshot.things[:MAX_NAMED]]
    if len(snapshot.things) > MAX_NAMED:
        lines.append(f"and {len(snapshot.things) - MAX_NAMED} more that can be moved")
    names = [model.name for model in snapshot.standing]
    more = f" and {len(names) - MAX_NAMED} more" if len(names) > MAX_NAMED else ""
    return [*lines, f"static: {', '.join(names[:MAX_NAMED])}{more}"] if names else lines
