"""The inbox of a queue: what other threads and signal handlers put there."""

from __future__ import annotations

import threading

from rosmini.core.graph.event_queue import Inbox

LONG = 300.0


def test_no_wait_outlasts_its_timeout_however_short_that_is():
    # Python 3.11's SimpleQueue hangs here for ever, most often within 20,000 rounds on a machine that is busy
    inbox: Inbox[int] = Inbox()
    for _ in range(50_000):
        inbox.put(1)
        inbox.get()
        inbox.wait(2e-7)
    assert inbox.empty()


def test_what_many_threads_put_all_arrives():
    inbox: Inbox[int] = Inbox()
    threads = [threading.Thread(target=lambda: [inbox.put(n) for n in range(1000)]) for _ in range(4)]
    for thread in threads:
        thread.start()
    got = []
    while len(got) < 4000:
        inbox.wait(LONG)
        while not inbox.empty():
            got.append(inbox.get())
    for thread in threads:
        thread.join()
    assert sorted(got) == sorted([*range(1000)] * 4)
