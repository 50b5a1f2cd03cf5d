"""Checks of the exercises in the chapter The command line."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.msgs.std_msgs.msg import Empty, Float32

# ---- commands: which command? ----

COMMANDS = {
    "Does /simulator answer?": {"rosnode ping"},
    "How many messages per second arrive on /imu?": {"rostopic hz"},
    "Which topics carry nav_msgs/Odometry?": {"rostopic find"},
    "Which fields does sensor_msgs/Imu have?": {"rosmsg show", "rosmsg info"},
    "Which arguments does /driver/set_logger_level take?": {"rosservice args", "rosservice info"},
    "How do I save all parameters in a file?": {"rosparam dump"},
    "How long is drive.bag?": {"rosbag info"},
}
"""The commands that answer each question."""


@exercise("commands", praise="You know the command for each of the seven questions.")
def commands(answer: object) -> None:
    """A tool and a verb for each question; arguments are ignored."""
    expect_type(answer, dict, "commands is", "a dictionary from question to command")
    given: dict[str, Any] = dict(answer)  # type: ignore[call-overload]
    for question, right in COMMANDS.items():
        said = str(given.get(question, ""))
        words = said.removeprefix("$").strip().removeprefix("%").removeprefix("rosmini ").split()
        tool = next(iter(right)).split()[0]
        expect(
            " ".join(words[:2]) in right,
            f"{question} {said!r} does not answer this.",
            f"try {tool} -h" if words[:1] == [tool] else "choose the tool named after what the question is about",
        )


# ---- ask_the_robot: ask the robot ----

JOINT_STATES_HZ = 30
FACTS = {
    "type": ("sensor_msgs/JointState", "rostopic type /joint_states"),
    "frame": ("odom", "rostopic echo -n 1 /odom/header/frame_id"),
    "service": ("roscpp/SetLoggerLevel", "rosservice type with the name of the service"),
}
"""The right answers, and the commands that print them."""


@exercise("ask_the_robot", praise="You got all four answers from the running robot.")
def found(answer: object) -> None:
    """Four facts that ROS's tools print about the robot."""
    expect_type(answer, dict, "found is", "a dictionary with type, rate, frame and service")
    given: dict[str, Any] = dict(answer)  # type: ignore[call-overload]
    for key, (right, command) in FACTS.items():
        said = given.get(key)
        expect(isinstance(said, str) and said.strip() == right, f"{key} is not {said!r}.", f"run {command}")
    rate = given.get("rate")
    expect_type(rate, (int, float), "rate is", "a number, in messages per second")
    expect(
        abs(float(rate) - JOINT_STATES_HZ) < 1,  # type: ignore[arg-type]
        f"There are not {rate} messages a second on /joint_states.",
        "run rostopic hz --duration 2 /joint_states, and take the average rate",
    )


# ---- count: your own rostopic hz ----

BEATS_HZ = (4, 10, 0)
"""Numbers of beats a second, each for four seconds."""


@exercise("count", praise="Your node reports the rate, even when no messages arrive.")
def count(answer: Script) -> None:
    """The node publishes the number of beats since the last report once a second."""
    got: list[float] = []
    with Trial("arena", is_shown=False) as trial:
        trial.graph.node("listener").subscriber("rate", Float32, lambda message: got.append(message.data))
        beat = trial.graph.node("heart").publisher("beat", Empty, queue_size=10)
        trial.start(answer)
        trial.run(0.55)
        expect(beat.num_connections(), "No node subscribes to /beat.", "use rospy.Subscriber with type Empty")
        for rate in BEATS_HZ:
            got.clear()
            for _ in range(rate * 4):
                beat.publish(Empty())
                trial.run(1 / rate)
            if not rate:
                trial.run(4.0)
            expect(
                3 <= len(got) <= 5,
                f"In 4 s with {rate} beats a second, it published {len(got)} times on /rate.",
                "publish from a rospy.Timer with a period of one second",
            )
            expect(
                all(abs(told - rate) <= 1 for told in got[1:]),
                f"With {rate} beats a second it published {', '.join(f'{told:g}' for told in got)}.",
                "reset the counter after each report",
            )
