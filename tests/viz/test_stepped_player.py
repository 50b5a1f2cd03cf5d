"""The stepped player: which frame is shown where, and which frames it refuses."""

import itertools

import pytest

from rosmini.viz.stepped_player import Axis, Frame, Panel, SteppedPlayer
from rosmini.viz.view import ViewError

PANELS = [Panel("left", 320, 100, "<rect class='ground'/>"), Panel("right", 320, 50)]
AXES = [Axis("size", ["small", "large"]), Axis("colour", ["red", "green", "blue"])]
FRAMES = [
    Frame([f"<desc>{size}</desc>", f"<desc>{colour}</desc>"], f"{size} {colour}")
    for size, colour in itertools.product(AXES[0].values, AXES[1].values)
]


def player(frames=FRAMES, **options):
    return SteppedPlayer("shapes", PANELS, AXES, frames, text="six shapes", alt="Six shapes.", **options)


def test_the_still_picture_is_the_chosen_frame_on_its_ground():
    view = player(still=[1, 2])
    assert view.frame([1, 2]).text == "large blue"
    assert view.svg.count("rm-panel") == 2
    assert "<desc>large</desc>" in view.svg and "<desc>blue</desc>" in view.svg and "class='ground'" in view.svg
    assert "<desc>small</desc>" in player().svg and "<desc>small</desc>" not in view.svg
    assert (view.text, view.alt, view.name) == ("six shapes", "Six shapes.", "shapes")


def test_the_page_gets_every_frame_and_each_picture_once():
    data = player(first=[1, 0]).data
    assert data["axes"] == [["size", ["small", "large"]], ["colour", ["red", "green", "blue"]]]
    assert data["first"] == [1, 0]
    assert sorted(data["pictures"]) == sorted({picture for frame in FRAMES for picture in frame.pictures})
    (size, colour), text = data["frames"][4]
    assert (data["pictures"][size], data["pictures"][colour], text) == (*FRAMES[4].pictures, "large green")


@pytest.mark.parametrize("frames", [FRAMES[:-1], [*FRAMES[:-1], Frame(["one"], "too few pictures")]])
def test_frames_that_do_not_match_the_axes_or_panels_are_refused(frames):
    with pytest.raises(ViewError, match="2 panels needs 6 frames"):
        player(frames)
