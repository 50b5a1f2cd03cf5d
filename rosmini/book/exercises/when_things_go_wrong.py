"""Checks of the exercises in the chapter When things go wrong: they run scripts in faulty graphs."""

from __future__ import annotations

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.std_msgs.msg import Bool, Float64, String

# ---- greet: late listeners ----


@exercise("greet", praise="Late subscribers receive the message as well, exactly once.")
def greet(answer: Script) -> None:
    """One message on /greeting also reaches nodes that subscribe later."""
    heard: dict[str, list[str]] = {}
    with Trial("arena", is_shown=False) as trial:
        trial.start(answer)
        trial.run(2.0)
        for name in ("ada", "grace"):
            got = heard[name] = []
            trial.graph.node(name).subscriber("greeting", String, lambda m, got=got: got.append(m.data))
            trial.run(2.0)
            expect(
                got,
                f"/{name} subscribed late and received nothing.",
                "latch=True makes the Publisher keep its last message",
            )
        trial.run(30.0)
        for name, got in heard.items():
            expect(got[0] == "hello", f"/{name} received {got[0]!r}, not 'hello'.")
            expect(len(got) == 1, f"/{name} received it {len(got)} times.", "publish once; the latch does the rest")


# ---- watchdog: a watchdog ----


@exercise("watchdog", praise="The alarm is raised when scans stop, and only then.", gaps=2)
def watchdog(answer: Script) -> None:
    """The node publishes True on /alarm when no scan has arrived for a second, and otherwise False."""
    got: list[bool] = []
    with Trial("arena", is_shown=False) as trial:
        trial.graph.node("owner").subscriber("alarm", Bool, lambda m: got.append(m.data))
        trial.start(answer)
        trial.run(3.0)
        expect(got, "There was no message on /alarm.", "publish a Bool from a Timer, even while scans arrive")
        expect(not got[-1], "It raised the alarm although scans arrived.", "store the time of each scan")
        trial.graph.faults.disturb("/scan", lose=1.0)
        trial.run(0.75)
        expect(not got[-1], "It raised the alarm before a second without scans had passed.")
        got.clear()
        trial.run(1.2)
        expect(
            got and got[-1],
            "There was no scan for nearly 2 s, but no alarm.",
            "without scans their callback is not called, so compare the times in a Timer",
        )
        trial.graph.faults.clear()
        trial.run(1.0)
        expect(not got[-1], "Scans arrive again, but the alarm is still True.")


# ---- doctor: a doctor ----

MISSING = {"/battery": Float64, "/plan": String}


@exercise("doctor", praise="roswtf found the misspelt topic by the same rule.")
def doctor(answer: Script) -> None:
    """The script prints topics with subscribers but without publishers, one a line, sorted."""
    with Trial("arena", is_shown=False) as trial:
        for number, (topic, kind) in enumerate(MISSING.items()):
            trial.graph.node(f"waiting{number}").subscriber(topic, kind, print)
        talker = trial.graph.node("talker")
        talker.publisher("greeting", String)
        talker.subscriber("greeting", String, print)
        trial.start(answer)
        trial.run(1.0)
        found = trial.output.split()
        wanted = sorted(["/cmd_vel", *MISSING])
        for topic in wanted:
            expect(topic in found, f"{topic} has no publisher, but was not printed.", "compare the two lists")
        extra = [each for each in found if each not in wanted]
        expect(not extra, f"It also printed {extra[0] if extra else ''}.", "print only those without a publisher")
        expect(found == wanted, "The topics are not in alphabetical order, or not unique.", "use sorted(...)")
