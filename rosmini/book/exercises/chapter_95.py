"""What is right in the exercises of chapter 95, When things go wrong: scripts, tried in graphs that misbehave."""

from __future__ import annotations

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.std_msgs.msg import Bool, Float64, String

# ---- 95.1: late listeners ----


@exercise("95.1", praise="Whoever comes late still hears it, once.")
def greet(answer: Script) -> None:
    """One message on /greeting reaches those who subscribe after it was sent."""
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
                f"/{name} came late, and heard nothing.",
                "the Publisher can keep its last message: latch",
            )
        trial.run(30.0)
        for name, got in heard.items():
            expect(got[0] == "hello", f"/{name} heard {got[0]!r}, not 'hello'.")
            expect(
                len(got) == 1, f"/{name} heard it {len(got)} times.", "publish it once; latch does the rest"
            )


# ---- 95.2: a watchdog ----


@exercise("95.2", praise="It barks when the laser falls silent, and only then.", gaps=2)
def watchdog(answer: Script) -> None:
    """True on /alarm while no scan has come for a second, and False while they come."""
    got: list[bool] = []
    with Trial("arena", is_shown=False) as trial:
        trial.graph.node("owner").subscriber("alarm", Bool, lambda m: got.append(m.data))
        trial.start(answer)
        trial.run(3.0)
        expect(got, "Nothing came on /alarm.", "a Timer that publishes a Bool, also while all is well")
        expect(
            not got[-1], "It raised the alarm though scans came.", "note the time in the callback of the scan"
        )
        trial.graph.faults.disturb("/scan", lose=1.0)
        trial.run(0.75)
        expect(not got[-1], "It raised the alarm before a second had passed.")
        got.clear()
        trial.run(1.2)
        expect(
            got and got[-1],
            "For nearly 2 s no scan came, and there was no alarm.",
            "who calls you when none comes?",
        )
        trial.graph.faults.clear()
        trial.run(1.0)
        expect(not got[-1], "The scans are back, and the alarm goes on.")


# ---- 95.3: a doctor ----

MISSING = {"/battery": Float64, "/plan": String}


@exercise("95.3", praise="That is the rule by which roswtf found the misspelt topic.")
def doctor(answer: Script) -> None:
    """The topics that somebody subscribes to and nobody publishes are printed, one a line, sorted."""
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
            expect(
                topic in found, f"Nobody publishes {topic}, and it was not printed.", "compare the two lists"
            )
        extra = [each for each in found if each not in wanted]
        expect(not extra, f"It printed {extra[0] if extra else ''}, too.", "only topics without a publisher")
        expect(found == wanted, "They are not in alphabetical order, or one is there twice.", "sorted(...)")
