"""Checks of the exercises in the chapter Logging: a driver that says why it stops, and two nodes that read the log."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.roscpp.srv import GetLoggers, SetLoggerLevel
from rosmini.msgs.rosgraph_msgs.msg import Log
from rosmini.msgs.std_msgs.msg import String

WALL_X = 2.0
"""x coordinate of the arena's east wall [m]; a robot at the origin faces it."""

LEVELS = {Log.DEBUG: "DEBUG", Log.INFO: "INFO", Log.WARN: "WARN", Log.ERROR: "ERROR", Log.FATAL: "FATAL"}

# ---- say_why: levels and throttling ----


@exercise("say_why", praise="One line every five seconds says enough, and the details are there when they are needed.")
def say_why(answer: Script) -> Any:
    """A driver that logs each distance at DEBUG, and warns now and then while it stands."""
    with Trial("arena", "_x:=0.5") as trial:
        check, logs = trial.graph.node("check"), []
        check.subscriber("/rosout", Log, lambda log: logs.append(log) if log.name == "/driver" else None)
        trial.start(answer)
        trial.run(3.0)
        expect("/driver" in trial.graph.nodes, "There is no node /driver.", "keep the lines below the function")
        _expect_quiet(logs)
        set_level = check.service_client("/driver/set_logger_level", SetLoggerLevel)
        set_level(logger="rosout", level="debug")
        trial.run(1.0)
        count = sum(log.level == Log.DEBUG for log in logs)
        expect(
            4 <= count <= 6,
            f"At level DEBUG it logged {count} messages in a second of five scans.",
            "call rospy.logdebug at each scan",
        )
        set_level(logger="rosout", level="info")
        trial.run(6.0)
        x = trial.robot.truth()[0]
        gap = WALL_X - x
        expect(gap < 0.7, "The robot did not drive up to the wall.", "drive at 0.2 m/s while nothing is near")
        expect(gap > 0.3, "The robot did not stop half a metre from the wall.", "stop if ahead is less than 0.5")
        logs.clear()
        trial.run(20.0)
        _expect_only(logs, (Log.WARN,))
        expect(
            3 <= len(logs) <= 4,
            f"In 20 s in front of the wall it warned {len(logs)} times, not once every 5 s.",
            "use rospy.logwarn_throttle(5, ...)",
        )
        expect(
            all(any(sign.isdigit() for sign in log.msg) for log in logs),
            f"The warning {logs[0].msg!r} does not contain the distance.",
            'give it as a value: logwarn_throttle(5, "%.2f m ahead", ahead)',
        )
        trial.expect_no_errors()
        return trial.view()


def _expect_quiet(logs: list[Any]) -> None:
    """Expect no messages while the robot drives."""
    expect(
        not logs,
        f"While it drove, it logged {logs and logs[0].msg!r} at level {logs and LEVELS[logs[0].level]}.",
        "distances are logged at DEBUG, and warnings only while the robot is stopped",
    )


def _expect_only(logs: list[Any], levels: tuple[int, ...]) -> None:
    others = [log for log in logs if log.level not in levels]
    expect(
        not others,
        f"While it was stopped, it logged {others and others[0].msg!r} at level {others and LEVELS[others[0].level]}.",
        "log only warnings here",
    )


# ---- log_alarm: read the log ----

MESSAGES = (
    ("/arm", Log.WARN, "joint 3 is warm"),
    ("/arm", Log.ERROR, "joint 3 is stuck"),
    ("/camera", Log.INFO, "ERROR is the name of this picture"),
    ("/camera", Log.FATAL, "no camera"),
    ("/base", Log.DEBUG, "0.2 m/s"),
)


def _log(trial: Trial) -> Any:
    """Return a function that sends a log message in the name of a node."""
    publisher = trial.graph.node("check").publisher("/rosout_agg", Log, queue_size=10)

    def send(name: str, level: int, text: str) -> None:
        publisher.publish(Log(name=name, level=level, msg=text))
        trial.run(0.5)

    return send


@exercise("log_alarm", praise="It reads the log of every node, and passes on what matters.")
def log_alarm(answer: Script) -> None:
    """A node that publishes errors of all nodes as text."""
    with Trial("empty", is_shown=False) as trial:
        heard: list[str] = []
        send = _log(trial)
        trial.graph.node("ear").subscriber("alarm", String, lambda message: heard.append(message.data))
        trial.start(answer)
        trial.run(0.5)
        for name, level, text in MESSAGES:
            heard.clear()
            send(name, level, text)
            case = f"When {name} logged {text!r} at level {LEVELS[level]}, alarm said {heard}"
            if level >= Log.ERROR:
                expect(heard == [f"{name}: {text}"], f"{case}.", "publish log.name, a colon, a space and log.msg once")
            else:
                expect(not heard, f"{case}.", "compare log.level with Log.ERROR")
        trial.expect_no_errors()


# ---- look_closer: set a level ----


@exercise("look_closer", praise="Now the debug messages begin where the trouble is.")
def look_closer(answer: Script) -> None:
    """A node that sets the level of a node that has logged an error."""
    with Trial("empty", is_shown=False) as trial:
        send = _log(trial)
        names = ("/arm", "/left/camera", "/base")
        for name in names:
            trial.graph.node(name.rpartition("/")[2], namespace=name.rpartition("/")[0] or "/")
        trial.start(answer)
        trial.run(0.5)
        reader = trial.graph.node("reader")

        def loud() -> list[str]:
            clients = {name: reader.service_client(f"{name}/get_loggers", GetLoggers) for name in names}
            levels = {
                name: {each.name: each.level for each in client().loggers}["rosout"] for name, client in clients.items()
            }
            return [name for name, level in levels.items() if level == "DEBUG"]

        send("/arm", Log.WARN, "joint 3 is warm")
        expect(not loud(), "After a warning it changed a level.", "compare log.level with Log.ERROR")
        wanted: list[str] = []
        for name in names[:2]:
            send(name, Log.ERROR, "stuck")
            wanted.append(name)
            found = loud()
            expect(name in found, f"After an error in {name} its level is not DEBUG.", "call NAME/set_logger_level")
            expect(found == wanted, f"After an error in {name} the nodes {found} are at DEBUG.", "use log.name")
        trial.expect_no_errors()
