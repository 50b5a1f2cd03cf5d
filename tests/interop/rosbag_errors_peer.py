"""What `rosbag.Bag` raises: run with the `rosbag` of the system's Python as a script, or given ours by a test.

For each attempt the classes of what it raised (its own module's by their names, so that both agree), or what it
answered.
"""

import json
import sys
from pathlib import Path

BUILTIN = ("ValueError", "KeyError", "TypeError", "OSError", "FileNotFoundError", "IsADirectoryError")


def attempt(function):
    try:
        answer = function()
    except Exception as error:
        return [
            cls.__name__ for cls in type(error).__mro__ if cls.__name__ in BUILTIN or cls.__name__.startswith("ROSBag")
        ]
    return answer if isinstance(answer, (int, str, list)) else "fine"


def attempts(rosbag, String, Time, folder):
    """Yield names and attempts, of which each begins with the files that `prepare` made."""
    good, empty, text = folder / "good.bag", folder / "empty.bag", folder / "text.bag"
    with rosbag.Bag(str(good), "w") as bag:
        for i in range(3):
            bag.write("/chatter", String(str(i)), Time(i + 1))
    empty.write_bytes(b"")
    text.write_text("This is no bag.\n", encoding="ascii")
    data = good.read_bytes()
    for version in ("2.1", "2.9", "1.1", "3.0", "0.5"):
        (folder / f"v{version}.bag").write_bytes(data.replace(b"V2.0", f"V{version}".encode(), 1))
    (folder / "short.bag").write_bytes(data[:-10])
    (folder / "unindexed.bag").write_bytes(
        data[:13] + data[13:].replace(b"index_pos=" + data.split(b"index_pos=")[1][:8], b"index_pos=" + bytes(8), 1)
    )
    (folder / "header.bag").write_bytes(data[:13] + b"\xff" * 100 + data[113:])
    (folder / "lied.bag").write_bytes(data.replace(b"conn_count=\x01", b"conn_count=\x09"))
    (folder / "directory.bag").mkdir()

    def opened(name, mode="r", **options):
        with rosbag.Bag(str(folder / name), mode, **options) as bag:
            return bag.version

    names = [
        "good", "empty", "text", "missing", "v2.1", "v2.9", "v1.1", "v3.0", "v0.5", "short", "unindexed", "header",
        "lied", "directory",
    ]  # fmt: skip
    for name in names:
        yield f"open {name}", lambda name=name: opened(f"{name}.bag")
        yield (f"open {name} unindexed", lambda name=name: opened(f"{name}.bag", allow_unindexed=name == "unindexed"))
    for name in names:
        if name != "missing":
            yield f"append {name}", lambda name=name: opened(f"{name}.bag", "a")
    yield "open nothing", lambda: rosbag.Bag("")
    yield "open None", lambda: rosbag.Bag(None)
    yield "open in no folder", lambda: rosbag.Bag(str(folder / "no" / "new.bag"), "w")
    for mode in ("x", "rw", "rb"):
        yield f"mode {mode}", lambda mode=mode: opened("good.bag", mode)
    for compression in ("zip", "BZ2", None):
        yield (
            f"compression {compression}",
            lambda compression=compression: opened("new.bag", "w", compression=compression),
        )
        yield (
            f"option {compression}",
            lambda compression=compression: opened("new.bag", "w", options={"compression": compression}),
        )
    yield "options are a list", lambda: opened("new.bag", "w", options=[1])
    yield "threshold", lambda: opened("new.bag", "w", chunk_threshold=-1)
    yield "threshold by option", lambda: opened("new.bag", "w", options={"chunk_threshold": -1})

    uses = {
        "write": lambda bag: bag.write("/chatter", String("x"), Time(9)),
        "no topic": lambda bag: bag.write("", String("x"), Time(9)),
        "no message": lambda bag: bag.write("/chatter", None, Time(9)),
        "raw of three": lambda bag: bag.write("/chatter", (1, 2, 3), Time(9), raw=True),
        "raw of nothing": lambda bag: bag.write("/chatter", (), Time(9), raw=True),
        "read": lambda bag: [m.data for _, m, _ in bag.read_messages()],
        "read one": lambda bag: [m.data for _, m, _ in bag.read_messages("/chatter", start_time=Time(2))],
        "read none": lambda bag: [m.data for _, m, _ in bag.read_messages("/none")],
        "ask to read": lambda bag: bag.read_messages() and "asked",
        "iterate": lambda bag: len(list(bag)),
        "flush": lambda bag: bag.flush(),
        "size": lambda bag: bag.size > 0 and "positive",
        "compression": lambda bag: bag.compression,
        "set compression": lambda bag: setattr(bag, "compression", "bz2"),
        "set wrong compression": lambda bag: setattr(bag, "compression", "zip"),
        "set threshold": lambda bag: setattr(bag, "chunk_threshold", 5),
        "set wrong threshold": lambda bag: setattr(bag, "chunk_threshold", -5),
        "count": lambda bag: bag.get_message_count(),
        "count of": lambda bag: bag.get_message_count("/chatter"),
        "count of none": lambda bag: bag.get_message_count("/none"),
        "start": lambda bag: str(bag.get_start_time()),
        "end": lambda bag: str(bag.get_end_time()),
        "compression info": lambda bag: list(bag.get_compression_info()),
        "types": lambda bag: sorted(bag.get_type_and_topic_info()[0]),
        "close": lambda bag: bag.close(),
        "version": lambda bag: bag.version,
        "mode": lambda bag: bag.mode,
        "with": lambda bag: bag.__enter__() and "entered",
    }
    for name, use in uses.items():

        def closed(use=use):
            with rosbag.Bag(str(folder / "good.bag")) as bag:
                pass
            return use(bag)

        def written(use=use):
            bag = rosbag.Bag(str(folder / "closed.bag"), "w")
            bag.write("/chatter", String("x"), Time(1))
            bag.close()
            return use(bag)

        def reading(use=use):
            with rosbag.Bag(str(folder / "good.bag")) as bag:
                return use(bag)

        def writing(use=use):
            with rosbag.Bag(str(folder / "writing.bag"), "w") as bag:
                bag.write("/chatter", String("x"), Time(1))
                return use(bag)

        yield f"{name} after close", closed
        yield f"{name} after writing and close", written
        if name not in ("write", "set compression", "set threshold"):
            yield f"{name} while reading", reading
        yield f"{name} while writing", writing

    def empty_bag(use):
        with rosbag.Bag(str(folder / "none.bag"), "w"):
            pass
        with rosbag.Bag(str(folder / "none.bag")) as bag:
            return use(bag)

    for name in ("read", "count", "start", "end", "types"):
        yield f"{name} of an empty bag", lambda name=name: empty_bag(uses[name])

    def stream(mode):
        with open(good, mode) as file, rosbag.Bag(file) as bag:
            return bag.version

    yield "a stream", lambda: stream("rb")
    yield "a stream of text", lambda: stream("r")


def outcomes(rosbag, String, Time, folder):
    return {name: attempt(function) for name, function in attempts(rosbag, String, Time, folder)}


if __name__ == "__main__":
    import rosbag
    from genpy import Time
    from std_msgs.msg import String

    print(json.dumps(outcomes(rosbag, String, Time, Path(sys.argv[1]))))
