"""A scene as a view: what its displays say, and a still."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.viz.figures import WIDTH
from rosmini.viz.view import Picture, ViewError
from rosmini.viz.words import plural

from .config import Config
from .display import Display, Level
from .displays.group import Group
from .flat import draw
from .primitives import Primitive
from .projection import Projection, projection
from .scene import Layer, Scene
from .suggestions import suggested

if TYPE_CHECKING:
    from rosmini.graph import Graph

BACKDROP = ("rviz/Grid",)
"""Displays that a picture is not made larger for, if there is anything else."""
TALLEST = 2000.0


def rviz(
    graph: Graph, config: Config | str | Path | None = None, *, fixed_frame: str | None = None, duration: float = 1.0,
    title: str | None = None, width: float = WIDTH, height: float | None = None, fit: bool = False,
) -> Picture:  # fmt: skip
    """What RViz shows of a graph: listen for some time with the displays of a file, then draw.

    Args:
        graph: the graph.
        config: a `.rviz` file, or its path; without one, displays are chosen by what is published.
        fixed_frame: overrides that of the file.
        duration: how long to listen [s of graph time].
        title: a caption under the picture, and the first words of its text form.
        width: of the picture [CSS px].
        height: of the picture [CSS px]; as high as it needs if None.
        fit: from above and around everything, whatever the view of the file is.

    Raises:
        ConfigError: the file is no configuration of RViz.
        ViewError: the duration is not positive, or the picture too small or too large.

    """
    if not 0 < duration < float("inf"):
        raise ViewError(f"a duration is a positive number of seconds, not {duration!r:.40}")
    chosen = suggested(graph, fixed_frame) if config is None else config
    with Scene(graph, chosen, fixed_frame=fixed_frame) as scene:
        graph.run(duration)
        return still(scene, title=title, width=width, height=height, fit=fit)


def still(
    scene: Scene,
    *,
    title: str | None = None,
    width: float = WIDTH,
    height: float | None = None,
    fit: bool = False,
) -> Picture:
    """What a scene shows now, from where its view looks; with `fit`, from above and around everything."""
    for name, value in (("width", width), ("height", height)):
        if value is not None and not 100 <= value <= TALLEST:
            raise ViewError(f"the {name} of a picture is 100 to {TALLEST:g} pixels, not {value}")
    layers = scene.update()
    look = look_at(scene, layers, width, height, fit=fit)
    text, alt = words(scene, layers, title), alt_text(scene, layers)
    shown = [each for layer in layers for each in layer.primitives]
    svg = draw(shown, look, scene.options["Background Color"], title=title or "RViz", alt=alt)
    return Picture(svg, text=text, alt=alt, caption=title)


def look_at(
    scene: Scene, layers: Sequence[Layer], width: float, height: float | None, *, fit: bool = False
) -> Projection:
    """From where a scene is drawn without perspective."""
    sight = None if scene.view is None or fit else scene.view.sight(scene.context)
    fronts = [layer for layer in layers if layer.display.plugin_name not in BACKDROP and layer.primitives]
    shown: list[Primitive] = [each for layer in fronts or layers for each in layer.primitives]
    return projection(sight, shown, width, height)


def words(scene: Scene, layers: Sequence[Layer], title: str | None = None) -> str:
    """The text form: fixed frame, global status, and each display with its statuses."""
    count = len([display for display in scene if not isinstance(display, Group)])
    head = f"{title or 'RViz'}: {plural(count, 'display')}, fixed frame {scene.fixed_frame}"
    lines = [head]
    if scene.warning:
        lines.append(f"{scene.config.source}: {scene.warning}")
    level = max(each.level for each in scene.global_status)
    lines.append(f"Global Status: {level}")
    lines += [f"  {each}" for each in scene.global_status]
    drawn = {id(layer.display): len(layer.primitives) for layer in layers}
    for display in scene.displays:
        lines += _described(display, drawn, "")
    return "\n".join(lines)


def _described(display: Display, drawn: dict[int, int], indent: str) -> Iterator[str]:
    kind = display.plugin_name or getattr(display, "kind", "")
    if not display.enabled:
        yield f"{indent}{display.name} ({kind}): off"
        return
    yield f"{indent}{display.name} ({kind}): {display.level}"
    if isinstance(display, Group):
        for each in display.displays:
            yield from _described(each, drawn, indent + "  ")
        return
    transforms = [each for each in display.statuses if each.level is Level.OK and each.text == "Transform OK"]
    shown = [each for each in display.statuses if each not in transforms]
    if len(transforms) == 1:
        shown = list(display.statuses)
    yield from (f"{indent}  {each}" for each in shown)
    if len(transforms) > 1:
        yield f"{indent}  Transform OK: {', '.join(sorted(each.name for each in transforms))}"


def alt_text(scene: Scene, layers: Sequence[Layer]) -> str:
    """The picture in a sentence or two."""
    seen = [f"{layer.display.name}" for layer in layers if layer.primitives]
    silent = [
        f"{layer.display.name} ({layer.display.statuses[0].text})"
        for layer in layers
        if not layer.primitives and layer.display.statuses and not isinstance(layer.display, Group)
    ]
    said = f"RViz in the frame {scene.fixed_frame}: it shows {', '.join(seen) or 'nothing'}."
    return said + (f" Nothing of {', '.join(silent)}." if silent else "")
