"""A recorded run to play: a player in a page, with a still picture of the run where no script runs."""

from __future__ import annotations

from functools import cached_property

from rosmini.sim.recording import Recording
from rosmini.viz.embed import embed
from rosmini.viz.recording_pictures import RunScene, recording_picture
from rosmini.viz.replay.encode import replay_data
from rosmini.viz.rounding import fixed
from rosmini.viz.view import SVG_MIME, Picture, View, ViewError

SCRIPTS = ("rosmini-canvas.js", "rosmini-replay.js")
HEIGHT = 320
"""The least that a player takes [CSS px]: a phone's width of world, and the controls."""


class ReplayView(View):
    """The player. As text it says how the run went; as an image it is the picture that `recording_picture` draws."""

    def __init__(self, recording: Recording, *, title: str | None = None) -> None:
        self.recording = recording
        self.title = title

    @cached_property
    def text(self) -> str:
        """What happened, in numbers, as the picture of the run says it."""
        return RunScene(self.recording, scan=self._scanned).text(self._name)

    @cached_property
    def alt(self) -> str:
        """The run in two sentences."""
        run = self.recording
        return (
            f"Player of a run of {run.model.name} in the world {run.world.name}, {fixed(run.duration, 1)} seconds "
            f"long. The robot drives {fixed(run.distance, 2)} m; at the end its odometry is off by "
            f"{fixed(float(run.drift().position[-1]), 2)} m.{beside(run)}"
        )

    @cached_property
    def still(self) -> Picture:
        """The run in one picture: an SVG.

        Raises:
            ViewError: matplotlib, which draws it, is not installed.

        """
        return recording_picture(self.recording, scan=self._scanned, title=self._name)

    def _images(self) -> dict[str, bytes]:
        return {SVG_MIME: (self.still.svg or "").encode()}

    @cached_property
    def html(self) -> str:
        """The player: of the book, or self-contained, as `rosmini.viz.book_form.book_form` says."""
        return embed(
            SCRIPTS,
            "rosminiReplay.mount",
            replay_data(self.recording),
            title=self._name,
            alt=self.alt,
            height=HEIGHT,
            fallback_html=self.still.svg or "",
            caption=self.title,
        )

    @property
    def _scanned(self) -> bool:
        return len(self.recording.scans) > 0

    @property
    def _name(self) -> str:
        return self.title or f"Replay of {self.recording.model.name} in {self.recording.world.name}"


def beside(run: Recording) -> str:
    """A sentence about the other robots of a run; empty if there are none."""
    others = ", ".join(each.name for each in run.others[:6])
    more = f" and {len(run.others) - 6} more" if len(run.others) > 6 else ""
    return f" Beside it drive {others}{more}." if others else ""


def replay(recording: Recording, *, title: str | None = None) -> ReplayView:
    """A player for a recorded run: play, pause, scrub, speeds from a quarter to eight times, and keys for all of it.

    Args:
        recording: of a robot, and of others beside it if there were any.
        title: a caption, and the first words of the text form.

    Raises:
        ViewError: it is not a recording.

    """
    if not isinstance(recording, Recording):
        raise ViewError(
            f"replay shows a Recording, not a {type(recording).__name__}: record a run with rosmini.sim.Recorder, and "
            "give what its recording() returns"
        )
    return ReplayView(recording, title=title)
