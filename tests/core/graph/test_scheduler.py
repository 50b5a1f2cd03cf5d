"""The scheduler: lanes, simulated and wall time, waiting from everywhere, ends and interrupts."""

from __future__ import annotations

import os
import signal
import threading

import pytest

from rosmini.core.errors import RosminiError
from rosmini.core.graph import threads
from rosmini.core.graph.event_queue import TICK_QUANTUM_NS
from rosmini.core.graph.lanes import Lane, LaneExit
from rosmini.core.graph.scheduler import Scheduler

from ...processes import PATIENCE

SECOND = 10**9


@pytest.fixture(params=[True, False], ids=["simulated", "wall"])
def scheduler(request: pytest.FixtureRequest) -> Scheduler:
    """A scheduler in simulated time, and one in wall time that runs a thousand times too fast."""
    return Scheduler(simulated=request.param, rate=1.0 if request.param else 1000.0)


def test_lanes_interleave_only_where_they_block(scheduler: Scheduler) -> None:
    seen: list[str] = []

    def worker(name: str) -> None:
        for turn in range(3):
            seen.extend([f"{name}{turn}", f"{name}{turn}"])
            scheduler.sleep_until(scheduler.now_ns() + SECOND)

    done = [scheduler.spawn(name, lambda name=name: worker(name)) for name in "ab"]
    scheduler.run(until=lambda: all(lane.idle for lane in done))
    assert seen == ["a0", "a0", "b0", "b0", "a1", "a1", "b1", "b1", "a2", "a2", "b2", "b2"]


def test_tasks_of_a_lane_run_in_order_and_one_at_a_time(scheduler: Scheduler) -> None:
    seen: list[int] = []
    lane = scheduler.spawn("lane")

    def task(number: int) -> None:
        scheduler.sleep_until(scheduler.now_ns() + (3 - number) * SECOND)
        seen.append(number)

    for number in range(3):
        lane.submit(lambda number=number: task(number))
    scheduler.run(until=lambda: lane.idle)
    assert seen == [0, 1, 2]


def test_simulated_time_jumps_and_events_at_one_time_keep_their_order() -> None:
    scheduler = Scheduler()
    start = scheduler.now_ns()
    seen: list[tuple[float, str]] = []
    for when, name in [(5, "late"), (2, "first"), (2, "second"), (0, "now")]:
        scheduler.call_at(start + when * SECOND, lambda when=when, name=name: seen.append((when, name)))
    report = scheduler.run()
    assert seen == [(0, "now"), (2, "first"), (2, "second"), (5, "late")]
    assert report.reason == "drained"
    assert scheduler.now_ns() == start + 5 * SECOND


def test_the_report_says_what_each_lane_was_waiting_for() -> None:
    scheduler = Scheduler()
    scheduler.spawn("listener", scheduler.waiter("a message on /chatter").wait)
    report = scheduler.run()
    assert report.reason == "drained"
    (line,) = map(str, report.waiting)
    assert line.startswith("listener ") and line.endswith("a message on /chatter") and line in str(report)


def test_a_wait_for_another_process_holds_no_simulated_time_and_is_no_end() -> None:
    scheduler, seen = Scheduler(), []
    start = scheduler.now_ns()
    waiter = scheduler.waiter("an answer from afar", remote=True)

    def answer() -> None:
        threading.Thread(target=lambda: waiter.wake("hello"), name="afar").start()

    scheduler.call_at(start + SECOND, lambda: seen.append(scheduler.now_ns() - start))
    scheduler.call_at(start + 2 * SECOND, answer)
    assert waiter.wait()  # time passes while it waits, and nothing but the answer is left in the end
    assert (waiter.value, seen) == ("hello", [SECOND])


def test_a_wait_times_out_and_the_waiter_can_be_used_again(scheduler: Scheduler) -> None:
    waiter = scheduler.waiter("a word")
    assert waiter.wait(SECOND) is False
    scheduler.call_soon(lambda: waiter.wake("hello"))
    assert waiter.wait(SECOND) is True
    assert waiter.value == "hello"


def test_an_exception_in_a_lane_is_raised_where_the_queue_is_driven(scheduler: Scheduler) -> None:
    def fail() -> None:
        msg = "broken"
        raise ValueError(msg)

    lane = scheduler.spawn("lane", fail)
    seen: list[str] = []
    lane.submit(lambda: seen.append("the next task still runs"))
    with pytest.raises(ValueError, match="broken"):
        scheduler.run(until_ns=scheduler.now_ns() + SECOND)
    scheduler.run(until=lambda: bool(seen))
    assert seen == ["the next task still runs"]


def test_polling_loops_go_on_by_counting(scheduler: Scheduler) -> None:
    got: list[int] = []
    end = scheduler.now_ns() + SECOND
    scheduler.call_at(end, lambda: got.append(1))

    def poll() -> None:
        while not got:
            scheduler.tick()

    lane = scheduler.spawn("poll", poll)
    scheduler.run(until=lambda: lane.idle)
    assert got == [1]
    if scheduler.simulated:
        assert 0 <= scheduler.now_ns() - end <= TICK_QUANTUM_NS


@pytest.mark.parametrize(("pause_after", "milliseconds"), [(None, 20), (100, 0)])
def test_a_call_costs_time_from_the_hundredth_turn_without_a_blocking_call_on(
    pause_after: int | None, milliseconds: int
) -> None:
    scheduler = Scheduler()

    def poll() -> None:
        for number in range(1, 501):
            scheduler.turn()
            scheduler.charge(49)
            if pause_after is not None and number % pause_after == 0:
                scheduler.yield_to_others()

    begin = scheduler.now_ns()
    lane = scheduler.spawn("poll", poll)
    scheduler.run(until=lambda: lane.idle)
    assert scheduler.now_ns() - begin == milliseconds * TICK_QUANTUM_NS


def test_a_ping_pong_at_one_instant_does_not_stop_simulated_time() -> None:
    scheduler = Scheduler()

    def again() -> None:
        scheduler.call_soon(again)

    scheduler.call_soon(again)
    start = scheduler.now_ns()
    scheduler.run(until_ns=start + 2 * TICK_QUANTUM_NS)
    assert scheduler.now_ns() >= start + 2 * TICK_QUANTUM_NS


def test_a_killed_lane_ends_where_it_blocks_and_runs_its_clean_up(scheduler: Scheduler) -> None:
    seen: list[str] = []

    def work() -> None:
        try:
            scheduler.waiter("nothing").wait()
        except LaneExit:
            seen.append("asked to end")
            raise
        finally:
            seen.append("cleaned up")

    lane = scheduler.spawn("lane", work)
    lane.submit(lambda: seen.append("never"))
    scheduler.run(until=lambda: lane.waiting_for is not None)
    lane.kill()
    scheduler.run(until_ns=scheduler.now_ns() + SECOND)
    assert seen == ["asked to end", "cleaned up"]
    assert lane.dead


def test_contexts_change_only_between_lanes_that_differ_in_them(scheduler: Scheduler) -> None:
    seen: list[str] = []

    class Context:
        def __init__(self, name: str) -> None:
            self.name = name

        def enter(self) -> None:
            seen.append(f"enter {self.name}")

        def leave(self) -> None:
            seen.append(f"leave {self.name}")

    def nap() -> None:
        scheduler.sleep_until(scheduler.now_ns() + SECOND)

    one, two = Context("one"), Context("two")
    lanes = [scheduler.spawn(str(index), nap, context=context) for index, context in enumerate([one, one, two])]
    scheduler.run(until=lambda: all(lane.idle for lane in lanes))
    assert seen[:4] == ["enter one", "leave one", "enter two", "leave two"] or seen[:3] == [
        "enter one",
        "leave one",
        "enter two",
    ]
    assert seen[-1].startswith("leave"), "the main program runs in no script's context"
    depth = 0
    for entry in seen:
        depth += 1 if entry.startswith("enter") else -1
        assert depth in (0, 1)


def test_only_the_main_program_drives(scheduler: Scheduler) -> None:
    problems: list[BaseException] = []
    lane = scheduler.spawn("lane", scheduler.run, on_error=problems.append)
    scheduler.run(until=lambda: lane.idle)
    assert isinstance(problems[0], RosminiError)
    assert "only the main program drives" in str(problems[0])


def test_a_real_thread_calls_and_waits() -> None:
    scheduler = Scheduler(simulated=False)
    seen: list[object] = []

    def foreign() -> None:
        scheduler.adopt_thread("camera", node="node")
        seen.append(scheduler.current().node)
        seen.append(scheduler.run_in_scheduler(scheduler.is_scheduler_thread))
        waiter = scheduler.waiter("a word")
        scheduler.call_soon_threadsafe(lambda: waiter.wake("hello"))
        waiter.wait()
        seen.append(waiter.value)
        seen.append(scheduler.waiter("nothing").wait(1_000_000))
        scheduler.release_thread()
        seen.append("done")

    thread = threading.Thread(target=foreign)
    scheduler.call_soon(thread.start)
    scheduler.run(until=lambda: "done" in seen)
    thread.join()
    assert seen == ["node", True, "hello", False, "done"]


def test_simulated_time_stands_still_while_the_operating_system_is_asked() -> None:
    scheduler = Scheduler()
    before = scheduler.now_ns()
    seen: list[tuple[int, str]] = []
    asked, answer = threading.Event(), threading.Event()

    def ask() -> None:
        def block() -> str:
            asked.set()
            answer.wait(PATIENCE)
            return "answer"

        seen.append((scheduler.now_ns(), scheduler.in_thread(block)))

    scheduler.call_at(before + 5 * SECOND, lambda: seen.append((scheduler.now_ns(), "later")))
    scheduler.spawn("asks", ask)
    threading.Thread(target=lambda: (asked.wait(PATIENCE), answer.set())).start()
    scheduler.run()
    assert seen == [(before, "answer"), (before + 5 * SECOND, "later")]


def test_in_thread_passes_errors_on(scheduler: Scheduler) -> None:
    def fail() -> None:
        msg = "no such device"
        raise OSError(msg)

    with pytest.raises(OSError, match="no such device"):
        scheduler.in_thread(fail)


@pytest.mark.skipif(os.name == "nt", reason="os.kill sends no SIGINT on Windows")
def test_an_interrupt_stops_the_drive_and_leaves_the_lanes_alone(scheduler: Scheduler) -> None:
    seen: list[str] = []

    def interrupt() -> None:
        os.kill(os.getpid(), signal.SIGINT)
        seen.append("the callback is not torn")

    lane = scheduler.spawn("lane", interrupt)
    lane.submit(lambda: scheduler.sleep_until(scheduler.now_ns() + SECOND))
    lane.submit(lambda: seen.append("and goes on later"))
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        scheduler.run(until_ns=scheduler.now_ns() + 1000 * SECOND)
    assert signal.getsignal(signal.SIGINT) is before
    assert seen == ["the callback is not torn"]
    scheduler.run(until=lambda: len(seen) == 2)
    assert seen == ["the callback is not torn", "and goes on later"]


@pytest.mark.skipif(os.name == "nt", reason="os.kill sends no SIGINT on Windows")
def test_a_second_interrupt_ends_a_callback_that_never_comes_back(scheduler: Scheduler) -> None:
    def spin() -> None:
        for _ in range(2):
            os.kill(os.getpid(), signal.SIGINT)
        msg = "unreachable"
        raise AssertionError(msg)

    scheduler.spawn("lane", spin)
    with pytest.raises(KeyboardInterrupt):
        scheduler.run(until_ns=scheduler.now_ns() + 1000 * SECOND)
    assert scheduler.run(until_ns=scheduler.now_ns() + SECOND).reason == "time"


@pytest.mark.skipif(os.name == "nt", reason="os.kill sends no SIGINT on Windows")
def test_an_interrupt_that_ends_nothing_says_what_it_waits_for(
    scheduler: Scheduler, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(threads, "PATIENCE_S", 0)

    def heard() -> None:
        os.kill(os.getpid(), signal.SIGINT)
        timer = scheduler._interrupts._report_timer
        assert timer is not None
        timer.join(60)

    scheduler.spawn("/listener <- /chatter", heard)
    with pytest.raises(KeyboardInterrupt):
        scheduler.run(until_ns=scheduler.now_ns() + SECOND)
    told = capfd.readouterr().err
    assert "Ctrl-C: waiting for /listener <- /chatter to come back from heard (test_scheduler.py, line" in told
    assert "Press Ctrl-C again" in told


def test_many_that_block_do_not_add_up_to_the_limit_of_recursion() -> None:
    """Each starts as deep as the first, wherever the last one blocked."""
    scheduler, done = Scheduler(), []

    def task(number: int, depth: int = 20) -> None:
        if depth:
            task(number, depth - 1)
            return
        scheduler.sleep_until(scheduler.now_ns() + 10**9)
        done.append(number)

    for number in range(1_000):
        scheduler.spawn(f"lane {number}", lambda number=number: task(number))
    assert scheduler.run(scheduler.now_ns() + 2 * 10**9).reason == "time"
    assert done == list(range(1_000))
    scheduler.close()


# ---- fairness ------------------------------------------------------------------------------------------------------


def answer_each_other(scheduler: Scheduler) -> list[int]:
    """Two lanes that give each other work without end; returns when each turn was [ns]."""
    turns: list[int] = []
    one, other = scheduler.spawn("one"), scheduler.spawn("other")

    def play(lane: Lane, next_one: Lane) -> None:
        turns.append(scheduler.now_ns())
        next_one.submit(lambda: play(next_one, lane))

    one.submit(lambda: play(one, other))
    return turns


def test_simulated_time_goes_on_while_two_answer_each_other_without_end() -> None:
    scheduler = Scheduler()
    begin = scheduler.now_ns()
    turns = answer_each_other(scheduler)
    called: list[int] = []
    for delay in (1, 333_333, TICK_QUANTUM_NS, SECOND // 10 + 7):
        scheduler.call_at(begin + delay, lambda: called.append(scheduler.now_ns() - begin))
    assert scheduler.run(begin + SECOND // 2).reason == "time"
    assert called == [1, 333_333, TICK_QUANTUM_NS, SECOND // 10 + 7]
    assert turns == sorted(turns)
    assert len(turns) < 100_000


@pytest.mark.parametrize("kind", ["itself", "each other"])
def test_a_condition_is_looked_at_while_lanes_give_work_without_end(scheduler: Scheduler, kind: str) -> None:
    turns: list[int] = []
    if kind == "each other":
        turns = answer_each_other(scheduler)
    else:
        lane = scheduler.spawn("busy")

        def again() -> None:
            turns.append(scheduler.now_ns())
            lane.submit(again)

        lane.submit(again)
    assert scheduler.run(until=lambda: len(turns) > 30_000).reason == "condition"


def test_many_events_at_one_instant_that_end_are_one_instant() -> None:
    scheduler = Scheduler()
    done: list[int] = []
    for _ in range(200_000):
        scheduler.call_soon(lambda: done.append(scheduler.now_ns()))
    scheduler.run(scheduler.now_ns() + 1)
    assert len(done) == 200_000
    assert len(set(done)) == 1
