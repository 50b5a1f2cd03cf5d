"""The node `rviz/rviz`, which launch files start: ``<node pkg="rviz" type="rviz" args="-d file.rviz"/>``.

In a separate process it is a local page, as for `rosmini rviz`, which opens in a browser if there is a
screen. In a graph with other nodes, such as a notebook's, it opens nothing and prints how to see it.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.graph.show import has_own_process
from rosmini.core.packages import address_of
from rosmini.core.verbs import Parser
from rosmini.viz.rviz import Config

from .window import RVizWindow

if TYPE_CHECKING:
    from rosmini.core.graph import Node
    from rosmini.viz.live.loopback import PageServer


class RViz:
    """The RViz window of a launch file.

    Args:
        node: the started node.
        words: ``-d FILE``, a configuration, and ``-f FRAME``, which overrides the file's fixed frame.

    Raises:
        UsageError: invalid arguments.
        ConfigError: the file does not exist, or is not an RViz configuration.

    """

    def __init__(self, node: Node, *words: str) -> None:
        given = _parser().parse(words)
        config = None if given.display_config is None else Config.read(given.display_config)
        self.window: RVizWindow | None = None
        self._server: PageServer | None = None
        if not has_own_process(node.graph):
            file = given.display_config and f"-d {address_of(Path(given.display_config))}"
            frame = given.fixed_frame and f"-f {given.fixed_frame}"
            node.loginfo(
                f"This graph opens no window. To see RViz, run: {' '.join(filter(None, ('%rviz', file, frame)))}"
            )
            return
        self.window = RVizWindow(node.graph, config, fixed_frame=given.fixed_frame, node=node)
        node.on_shutdown(self.close)
        if self.window.scene.warning:
            node.logwarn(f"{self.window.scene.config.source}: {self.window.scene.warning}")
        self._serve(self.window)

    def _serve(self, window: RVizWindow) -> None:
        from rosmini.viz.live.loopback import PageServer, open_window

        self._server = PageServer(window.link.widget, title="RViz")
        open_window(self._server, window.node.name.lstrip("/"))

    def close(self) -> None:
        """Close the page. Calling it again has no effect."""
        if self._server is not None:
            self._server.close()
        if self.window is not None:
            self.window.scene.close()


def _parser() -> Parser:
    parser = Parser("rviz", "rviz [options]", "What RViz shows.", example="  rosrun rviz rviz -d my.rviz")
    parser.add_option("-d", "--display-config", metavar="FILE", help="a .rviz file")
    parser.add_option("-f", "--fixed-frame", metavar="FRAME", help="the frame in which everything is drawn")
    return parser
