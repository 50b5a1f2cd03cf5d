"""The scripts of `rospy_tutorials`: what the report's walk downloads is there by `rosrun`."""

from __future__ import annotations

import pytest

from rosmini.tools.main import main


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("talker.py + rospy_tutorials/listener.py", "I heard hello world 1000.1"),
        ("add_two_ints_server.py + rospy_tutorials/add_two_ints_client.py 2 3", "2 + 3 = 5"),
    ],
)
def test_the_scripts_do_what_the_tutorials_say(capsys, words, said):
    assert main(["run", *f"rospy_tutorials/{words}".split(), "--duration", "0.5"]) == 0
    assert said in capsys.readouterr().out
