"""Threads and locks of scripts: lanes in simulated time, real threads in wall time, the same behaviour."""

import pytest


def lines(ran):
    return [line.removeprefix("[script] ") for line in ran.lines]


def test_threads_run_and_are_joined(run):
    ran = run(
        """
        import threading, time
        class PublishThread(threading.Thread):
            def __init__(self, n):
                super(PublishThread, self).__init__()
                self.n = n
            def run(self):
                go.wait()
                if self.n == 30:
                    threads[1].join()
                time.sleep(0.001)
                print("thread", self.n, threading.current_thread() is self)
        go = threading.Event()
        threads = [PublishThread(n) for n in (30, 10)]
        for t in threads:
            t.daemon = True
            t.start()
        print([t.is_alive() for t in threads], threading.active_count(), isinstance(threads[0], threading.Thread))
        threads[0].join(0.0001)
        print(threads[0].is_alive())
        go.set()
        for t in threads: t.join()
        is_main = threading.current_thread() is threading.main_thread()
        print([t.is_alive() for t in threads], threading.active_count(), is_main)
        print(threading.current_thread().name, threads[0].daemon, threads[0].getName() == threads[0].name)
        """
    )
    assert lines(ran) == [
        "[True, True] 3 True",
        "True",
        "thread 10 True",
        "thread 30 True",
        "[False, False] 1 True",
        "MainThread True True",
    ]


def test_the_end_waits_for_threads_but_not_for_daemons(run):
    ran = run(
        """
        import threading, time, atexit
        atexit.register(print, "exit")
        def work():
            time.sleep(0.02)
            print("worked")
            threading.Thread(target=print, args=("more",)).start()
        threading.Thread(target=work).start()
        def forever():
            try:
                while True: time.sleep(0.001)
            finally:
                done.append(1)
        done = []
        threading.Thread(target=forever, daemon=True).start()
        print("main is over")
        """
    )
    assert lines(ran) == ["main is over", "worked", "more", "exit"]
    assert ran.status == 0


@pytest.mark.parametrize(
    "loop",
    [
        "while True: pass",
        "while True: time.sleep(1e9)",
        "lock.acquire()",
        "queue.Queue().get()",
        "for _ in iter(int, 1): event.is_set()",
    ],
)
def test_daemons_end_with_the_script(run, loop):
    ran = run(
        f"""
        import threading, time, queue
        lock, event = threading.Lock(), threading.Event()
        lock.acquire()
        def work():
            started.set()
            {loop}
        started = threading.Event()
        threading.Thread(target=work, daemon=True).start()
        started.wait()
        print("over")
        """
    )
    assert lines(ran) == ["over"]


def test_an_exception_in_a_thread_is_reported(run):
    ran = run(
        """
        import threading
        def bad():
            raise KeyError("thread")
        t = threading.Thread(target=bad, name="worker"); t.start(); t.join()
        threading.excepthook = lambda args: print("hook", args.exc_type.__name__, args.thread.name)
        t = threading.Thread(target=bad, name="second"); t.start(); t.join()
        threading.excepthook = threading.__excepthook__
        t = threading.Thread(target=exit); t.start(); t.join()
        print("still here")
        """
    )
    text = lines(ran)
    assert text[0] == "Exception in thread worker:"
    assert text[1] == "Traceback (most recent call last):"
    assert text[2] == '  File "<script>", line 4, in bad'
    assert "KeyError: 'thread'" in text
    assert text[-2:] == ["hook KeyError second", "still here"]
    assert ran.status == 0


def test_misuse_is_refused(run):
    ran = run(
        """
        import threading
        def tried(f, *args, **kwargs):
            try:
                f(*args, **kwargs)
            except Exception as e:
                print(type(e).__name__, e)
        t = threading.Thread(target=print, args=("ran",))
        tried(t.join)
        t.start(); t.join()
        tried(t.start)
        tried(t.setDaemon, True)
        tried(threading.current_thread().join)
        lock = threading.Lock()
        tried(lock.release)
        tried(lock.acquire, False, 1)
        tried(lock.acquire, True, -2)
        tried(threading.RLock().release)
        tried(threading.Condition().wait)
        tried(threading.Condition().notify)
        tried(threading.BoundedSemaphore(1).release)
        tried(threading.Semaphore, -1)
        """
    )
    assert [line.split()[0] for line in lines(ran)] == [
        "RuntimeError", "ran", "RuntimeError", "RuntimeError", "RuntimeError", "RuntimeError", "ValueError",
        "ValueError", "RuntimeError", "RuntimeError", "RuntimeError", "ValueError", "ValueError",
    ]  # fmt: skip


def test_locks(run):
    ran = run(
        """
        import threading, time
        lock, total = threading.Lock(), 0
        def add():
            global total
            for _ in range(20):
                with lock:
                    before = total
                    time.sleep(0.00001)
                    total = before + 1
        threads = [threading.Thread(target=add) for _ in range(3)]
        [t.start() for t in threads]; [t.join() for t in threads]
        print(total, lock.locked())
        lock.acquire()
        print(lock.acquire(False), lock.acquire(timeout=0.001))
        threading.Timer(0.002, lock.release).start()
        print(lock.acquire(timeout=1000))
        r = threading.RLock()
        with r:
            with r:
                t = threading.Thread(target=lambda: print("other", r.acquire(False))); t.start(); t.join()
        t = threading.Thread(target=lambda: print("free", r.acquire(False))); t.start(); t.join()
        """
    )
    assert lines(ran) == ["60 False", "False False", "True", "other False", "free True"]


def test_condition_wait_for_and_notify_all(run):
    ran = run(
        """
        import threading, time
        c = threading.Condition(threading.Lock())
        items, got = [], []
        def take(n):
            with c:
                ok = c.wait_for(lambda: len(items) >= n, timeout=1000)
                got.append((n, ok))
        ts = [threading.Thread(target=take, args=(n,)) for n in (1, 2)]
        [t.start() for t in ts]
        for i in range(2):
            time.sleep(0.001)
            with c:
                items.append(i); c.notify_all()
        [t.join() for t in ts]
        with c:
            print(sorted(got), c.wait(0.001), c.wait_for(lambda: False, 0.001))
        """
    )
    assert lines(ran) == ["[(1, True), (2, True)] False False"]


def test_event_semaphore_barrier_timer_local(run):
    ran = run(
        """
        import threading, time
        e = threading.Event()
        print(e.wait(0.001), e.is_set())
        threading.Timer(0.001, e.set).start()
        print(e.wait(5)); e.clear(); print(e.wait(0))
        s = threading.BoundedSemaphore(2)
        print(s.acquire(), s.acquire(), s.acquire(False), s.acquire(timeout=0.001)); s.release(); print(s.acquire())
        b = threading.Barrier(2, timeout=1000)
        out = []
        t = threading.Thread(target=lambda: out.append(b.wait())); t.start()
        out.append(b.wait()); t.join(); print(sorted(out), b.broken)
        b.abort()
        try: b.wait()
        except threading.BrokenBarrierError: print("broken")
        cancelled = threading.Timer(30, print, ["never"]); cancelled.start(); cancelled.cancel(); cancelled.join()
        mine = threading.local(); mine.x = "main"
        def other():
            print(hasattr(mine, "x")); mine.x = "other"
        t = threading.Thread(target=other); t.start(); t.join(); print(mine.x)
        import _thread
        done = _thread.allocate_lock(); done.acquire()
        _thread.start_new_thread(lambda a: (print("raw", a), done.release()), (1,))
        with done: print("end", isinstance(done, _thread.LockType))
        """
    )
    assert lines(ran) == [
        "False False", "True", "False", "True True False False", "True", "[0, 1] False", "broken", "False", "main",
        "raw 1", "end True",
    ]  # fmt: skip


def test_queues(run):
    ran = run(
        """
        import queue, threading, time
        from queue import Empty, Full
        q = queue.Queue(maxsize=1)
        def produce():
            for i in range(3):
                q.put(i)
            q.put(None)
        threading.Thread(target=produce).start()
        got = []
        while True:
            item = q.get(); q.task_done()
            if item is None: break
            got.append(item)
        q.join()
        print(got, q.empty())
        try: q.get(timeout=0.001)
        except Empty: print("empty")
        q.put(1)
        try: q.put_nowait(2)
        except Full: print("full")
        p = queue.PriorityQueue(); [p.put(x) for x in (3, 1, 2)]
        l = queue.LifoQueue(); [l.put(x) for x in (3, 1, 2)]
        s = queue.SimpleQueue(); threading.Timer(0.001, s.put, ["simple"]).start()
        print([p.get() for _ in "abc"], [l.get() for _ in "abc"], s.get())
        """
    )
    assert lines(ran) == ["[0, 1, 2] True", "empty", "full", "[1, 2, 3] [2, 1, 3] simple"]


def test_thread_pool(run):
    ran = run(
        """
        import time
        from concurrent.futures import ThreadPoolExecutor, as_completed, TimeoutError
        def work(n):
            time.sleep(n / 500)
            return n * n
        with ThreadPoolExecutor(max_workers=3) as pool:
            print(list(pool.map(work, [3, 1, 2])))
            print(sorted(f.result() for f in as_completed([pool.submit(work, n) for n in (3, 1, 2)])))
            bad = pool.submit(lambda: 1 / 0)
            print(type(bad.exception()).__name__)
        left = ThreadPoolExecutor(1); print(left.submit(work, 1).result())
        """
    )
    assert lines(ran) == ["[9, 1, 4]", "[1, 4, 9]", "ZeroDivisionError", "1"]
