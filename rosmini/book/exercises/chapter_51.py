"""What is right in the exercises of chapter 51, The command line."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.msgs.std_msgs.msg import Empty, Float32

# ---- 51.1: which command? ----

COMMANDS = {
    "Does /simulator answer?": {"rosnode ping"},
    "How many messages a second come on /imu?": {"rostopic hz"},
    "Which topics carry nav_msgs/Odometry?": {"rostopic find"},
    "Which fields has sensor_msgs/Imu?": {"rosmsg show", "rosmsg info"},
    "What has to be given to /driver/set_logger_level?": {"rosservice args", "rosservice info"},
    "How do I save all parameters in a file?": {"rosparam dump"},
    "How long is drive.bag?": {"rosbag info"},
}
"""For each question the commands that answer it."""


@exercise("51.1", praise="Seven questions, seven commands.")
def commands(answer: object) -> None:
    """For each question a tool and a verb; what follows them does not matter."""
    expect_type(answer, dict, "commands is", "a dictionary: a question, and its command")
    given: dict[str, Any] = dict(answer)  # type: ignore[call-overload]
    for question, right in COMMANDS.items():
        said = str(given.get(question, ""))
        words = said.removeprefix("$").strip().removeprefix("%").removeprefix("rosmini ").split()
        tool = next(iter(right)).split()[0]
        expect(
            " ".join(words[:2]) in right,
            f"{question} {said!r} does not tell.",
            f"try {tool} -h" if words[:1] == [tool] else "which tool has the name of what is asked about?",
        )


# ---- 51.2: ask the robot ----

JOINT_STATES_HZ = 30
FACTS = {
    "type": ("sensor_msgs/JointState", "rostopic type /joint_states"),
    "frame": ("odom", "rostopic echo -n 1 /odom/header/frame_id"),
    "service": ("roscpp/SetLoggerLevel", "rosservice type, and the name of the service"),
}
"""What the robot says, and the command that makes it do so."""


@exercise("51.2", praise="You asked, and the robot told you.")
def found(answer: object) -> None:
    """What the robot's tools say about it."""
    expect_type(answer, dict, "found is", "a dictionary with type, rate, frame and service")
    given: dict[str, Any] = dict(answer)  # type: ignore[call-overload]
    for key, (right, command) in FACTS.items():
        said = given.get(key)
        expect(isinstance(said, str) and said.strip() == right, f"{key} is not {said!r}.", command)
    rate = given.get("rate")
    expect_type(rate, (int, float), "rate is", "a number, in messages per second")
    expect(
        abs(float(rate) - JOINT_STATES_HZ) < 1,  # type: ignore[arg-type]
        f"There are not {rate} messages a second on /joint_states.",
        "rostopic hz --duration 2 /joint_states, and then the average rate",
    )


# ---- 51.3: your own rostopic hz ----

BEATS_HZ = (4, 10, 0)
"""How many beats come in a second, for four seconds each."""


@exercise("51.3", praise="Your node counts what it hears, and tells when it hears nothing.")
def count(answer: Script) -> None:
    """Once a second the number of beats since the last report."""
    got: list[float] = []
    with Trial("arena", is_shown=False) as trial:
        trial.graph.node("listener").subscriber("rate", Float32, lambda message: got.append(message.data))
        beat = trial.graph.node("heart").publisher("beat", Empty, queue_size=10)
        trial.start(answer)
        trial.run(0.55)
        expect(beat.num_connections(), "Nobody subscribes to /beat.", "rospy.Subscriber, with the type Empty")
        for rate in BEATS_HZ:
            got.clear()
            for _ in range(rate * 4):
                beat.publish(Empty())
                trial.run(1 / rate)
            if not rate:
                trial.run(4.0)
            expect(
                3 <= len(got) <= 5,
                f"In 4 s, with {rate} beats in each, it published {len(got)} times on /rate.",
                "a rospy.Timer with a period of one second publishes",
            )
            expect(
                all(abs(told - rate) <= 1 for told in got[1:]),
                f"With {rate} beats a second it said {', '.join(f'{told:g}' for told in got)}.",
                "begin to count anew after each report",
            )
