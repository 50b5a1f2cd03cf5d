"""Pages that the tests play: they say what they are told to, keep what they are sent, and set the wall's clock."""

from types import SimpleNamespace

import numpy as np


class Page:
    """A page of something live; `link` makes its link from the clock."""

    def __init__(self, graph, link, *, step=0.01, beat=0.25):
        self.graph, self.wall, self.lives, self.sent = graph, 100.0, 0, []
        self.step, self.every = step, round(beat / step)
        graph.live = self.live
        self.link = link(lambda: self.wall)
        self.link.widget.send = self.get

    def get(self, content, buffers=None):
        self.sent.append((content, buffers or []))

    def live(self):
        """Make the graph say that it is live, while the test drives it."""
        self.lives += 1
        self.graph._live = SimpleNamespace(running=True, stop=lambda: None)

    def say(self, kind, **more):
        self.link.receive(self.link.widget, {"type": kind, **more}, [])

    def run(self, seconds, *, beats=True):
        """Let the graph and the wall's clock go on together, a step at a time."""
        for i in range(round(seconds / self.step)):
            if beats and i % self.every == 0:
                self.say("beat")
            self.wall += self.step
            self.graph.run(self.step)

    def of(self, kind):
        return [(content, buffers) for content, buffers in self.sent if content["type"] == kind]

    def kinds(self):
        return [content["type"] for content, _ in self.sent]

    def frames(self):
        return [(content, np.frombuffer(buffers[0])) for content, buffers in self.of("frame")]
