"""A scene as a view: a text with the statuses of its displays, and a still picture."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from rosmini.core.graph import Graph
from rosmini.core.plugins import PluginError
from rosmini.viz.figures import WIDTH
from rosmini.viz.meshcat.view import MeshcatView
from rosmini.viz.style import hex_colour
from rosmini.viz.view import Picture, View, ViewError
from rosmini.viz.words import plural

from .config import Config
from .context import FIXED_FRAME
from .display import Display, Level
from .displays.group import Group
from .flat import draw
from .labels import place_labels
from .primitives import Primitive, Text
from .projection import ParallelProjection, Perspective, Projection, parallel_projection
from .scene import Layer, Scene
from .solid import Drawing, RvizScene, camera_of, text_labels
from .suggestions import suggested
from .views import Viewpoint, view_like

BACKDROP = ("rviz/Grid",)
"""Displays that do not enlarge a picture if there are others."""
MAX_HEIGHT = 2000.0
STEP = 0.1
"""Resolution to which a picture in perspective is rounded [px]."""
STEEP = 1.5
"""Width of the view relative to the content's height at which an inclined view still shows all of it."""
DEFAULT_HEIGHT = 420.0
"""Default height of the view in three dimensions [CSS px]."""


def rviz(
    graph: Graph, config: Config | str | Path | None = None, *, fixed_frame: str | None = None, duration: float = 1.0,
    title: str | None = None, width: float = WIDTH, height: float | None = None, fit: bool = False,
    turn: bool = False, view: str | None = None,
) -> View:  # fmt: skip
    """Show a graph in RViz: listen for some time with the displays of a file, then draw.

    Args:
        graph: the graph.
        config: a `.rviz` file, or its path; without one, published topics determine the displays.
        fixed_frame: overrides the fixed frame of the file.
        duration: the time to listen [s of graph time].
        title: a caption under the picture, and the first words of its text form.
        width: width of the still picture [CSS px].
        height: height of the picture [CSS px]; None for the height that it needs.
        fit: show everything from above, whatever the view in the file.
        turn: show a view in three dimensions, which can be turned in the page, instead of the still picture.
        view: the kind of a view of everything, such as `Orbit`, which replaces the view in the file.

    Raises:
        ConfigError: the file is not a configuration of RViz.
        ViewError: the duration is not positive, the picture is too small or too large, or the view is unknown.

    """
    if not 0 < duration < float("inf"):
        raise ViewError(f"the duration must be a positive number of seconds, not {duration!r:.40}")
    chosen = suggested(graph, fixed_frame) if config is None else config
    with Scene(graph, chosen, fixed_frame=fixed_frame) as scene:
        graph.run(duration)
        if view is not None:
            look_from(scene, view)
        if turn:
            return turnable(scene, title=title, height=height, fit=fit)
        return still(scene, title=title, width=width, height=height, fit=fit)


def look_from(scene: Scene, kind: str) -> None:
    """Set a view of everything of a kind such as `Orbit` or `TopDownOrtho`; an orbiting view looks from the side.

    Raises:
        ViewError: the view does not exist.

    """
    view, scene.view = scene.view, None
    projection = flat_projection(scene, scene.update(), WIDTH, None)
    around = Viewpoint(projection.ground, -math.pi / 2, math.pi / 2, projection.width / projection.scale)
    try:
        scene.view = view_like(f"rviz/{kind}", around, FIXED_FRAME, scene.context)
    except PluginError as error:
        scene.view = view
        raise ViewError(str(error)) from error


def still(
    scene: Scene, *, title: str | None = None, width: float = WIDTH, height: float | None = None, fit: bool = False
) -> Picture:
    """Return a picture of a scene from its current view; with `fit`, of everything from above."""
    layers = scene.update()
    alt = alt_text(scene, layers)
    svg = _drawn(scene, layers, title, width, height, fit=fit)
    return Picture(svg, text=words(scene, layers, title), alt=alt, caption=title)


def turnable(scene: Scene, *, title: str | None = None, height: float | None = None, fit: bool = False) -> RvizView:
    """Return a scene in three dimensions, which the reader can turn. Its image is the still picture."""
    layers = scene.update()
    svg = _drawn(scene, layers, title, WIDTH, height, fit=fit)
    text, alt = words(scene, layers, title), alt_text(scene, layers)
    projection = flat_projection(scene, layers, WIDTH, height, fit=fit)
    reach = max(WIDTH, STEEP * projection.height) / projection.scale
    around = Viewpoint(projection.ground, -math.pi / 2, math.radians(50.0), reach)
    given = None if scene.view is None or fit else scene.view.viewpoint(scene.context)
    made = RvizScene(camera_of(around if given is None or not given.width else given, reach))
    drawing = Drawing(made)
    for layer in layers:
        drawing.add(layer.primitives)
    texts = [each for layer in layers for each in layer.primitives if isinstance(each, Text)]
    colour = scene.options["Background Color"]
    background = hex_colour(colour)
    ink = "#ffffff" if sum(colour) < 384 else "#000000"
    high = round(height or DEFAULT_HEIGHT)
    view = RvizView(made, label=title or "RViz", text=text, alt=alt, height=high)
    view.title, view.still = title, svg
    labels = text_labels(place_labels(texts, projection, shifts=0), made.camera)
    view.extra = {"background": [background, background, ink], "labels": labels}
    return view


class RvizView(MeshcatView):
    """A scene that can be turned; its image is the still picture."""

    still: str = ""

    @property
    def svg(self) -> str:
        """The still picture."""
        return self.still


def _drawn(
    scene: Scene, layers: Sequence[Layer], title: str | None, width: float, height: float | None, *, fit: bool
) -> str:
    for name, value in (("width", width), ("height", height)):
        if value is not None and not 100 <= value <= MAX_HEIGHT:
            raise ViewError(f"the {name} of a picture must be 100 to {MAX_HEIGHT:g} pixels, not {value}")
    projection: Projection = flat_projection(scene, layers, width, height, fit=fit)
    viewpoint = None if scene.view is None or fit else scene.view.viewpoint(scene.context)
    if viewpoint is not None and not viewpoint.is_flat:
        projection = Perspective.of(viewpoint, projection.width, projection.height, STEP)
    shown = [each for layer in layers for each in layer.primitives]
    panes = [each for layer in layers for each in layer.panes]
    alt = alt_text(scene, layers)
    return draw(shown, projection, scene.options["Background Color"], title=title or "RViz", alt=alt, panes=panes)


def flat_projection(
    scene: Scene, layers: Sequence[Layer], width: float, height: float | None, *, fit: bool = False
) -> ParallelProjection:
    """Return the projection in which a scene is drawn without perspective."""
    viewpoint = None if scene.view is None or fit else scene.view.viewpoint(scene.context)
    fronts = [layer for layer in layers if layer.display.plugin_name not in BACKDROP and layer.primitives]
    shown: list[Primitive] = [each for layer in fronts or layers for each in layer.primitives]
    return parallel_projection(viewpoint, shown, width, height)


def words(scene: Scene, layers: Sequence[Layer], title: str | None = None) -> str:
    """Return the text form: fixed frame, global status, and each display with its statuses."""
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
    """Describe the picture in one or two sentences."""
    seen = [f"{layer.display.name}" for layer in layers if layer.primitives]
    silent = [
        f"{layer.display.name} ({layer.display.statuses[0].text})"
        for layer in layers
        if not layer.primitives and layer.display.statuses and not isinstance(layer.display, Group)
    ]
    said = f"RViz in the frame {scene.fixed_frame}: it shows {', '.join(seen) or 'nothing'}."
    return said + (f" Nothing of {', '.join(silent)}." if silent else "")
