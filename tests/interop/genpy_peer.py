"""Run by /usr/bin/python3: makes, writes, prints and reads messages with the real genpy.

Reads one pickle from standard input and writes one pickle with an answer for each job in it to standard output. A job
is (type, full text, list of plain messages): a plain message is a dict of its fields, a time is a tuple (secs, nsecs);
or (type, full text, field, expression): is a message whose field is the value of this Python expression written?
"""

import io
import pickle
import sys

import genpy.dynamic
import genpy.message
import numpy as np

TIMES = {"time": genpy.Time, "duration": genpy.Duration}


def fill(classes, message, plain):
    for name, slot_type in zip(message.__slots__, message._slot_types, strict=True):
        setattr(message, name, value(classes, slot_type, plain[name]))
    return message


def value(classes, slot_type, plain):
    base, bracket, _ = slot_type.partition("[")
    if bracket and isinstance(plain, list):
        return [value(classes, base, element) for element in plain]
    if base in TIMES:
        return TIMES[base](*plain)
    return fill(classes, classes[base](), plain) if isinstance(plain, dict) else plain


def describe(thing):
    if isinstance(thing, genpy.Message):
        return (thing._type, [(name, describe(getattr(thing, name))) for name in thing.__slots__])
    if isinstance(thing, genpy.rostime.TVal):
        return (type(thing).__name__, thing.secs, thing.nsecs)
    if isinstance(thing, (list, tuple)):
        return (type(thing).__name__, [describe(element) for element in thing])
    if isinstance(thing, np.ndarray):
        return ("ndarray", str(thing.dtype), repr(thing.tolist()))
    return (type(thing).__name__, repr(thing))


def answer(type_name, full_text, plain_messages):
    classes = genpy.dynamic.generate_dynamic(type_name, full_text)
    installed = genpy.message.get_message_class(type_name) if not type_name.endswith(("Request", "Response")) else None
    cls = classes[type_name]
    result = {
        "md5": cls._md5sum,
        "installed_md5": installed and installed._md5sum,
        "full_text": cls._full_text,
        "has_header": cls._has_header,
        "slots": (list(cls.__slots__), list(cls._slot_types)),
        "constants": {
            name: repr(thing)
            for name, thing in vars(cls).items()
            if not name.startswith("_") and not callable(thing) and name not in cls.__slots__
        },
        "default": describe(cls()),
        "messages": [],
    }
    for plain in plain_messages:
        message = fill(classes, cls(), plain)
        buffer = io.BytesIO()
        message.serialize(buffer)
        data = buffer.getvalue()
        received = cls().deserialize(data)
        result["messages"].append(
            {
                "data": data,
                "text": str(message),
                "received": describe(received),
                "received_text": str(received),
                "received_numpy": describe(cls().deserialize_numpy(data, np)) if "bool[" not in full_text else None,
            }
        )
    return result


def attempt(type_name, full_text, field, expression):
    classes = genpy.dynamic.generate_dynamic(type_name, full_text)
    message = classes[type_name]()
    names = {"np": np, "Time": genpy.Time, "Duration": genpy.Duration}
    setattr(message, field, eval(expression, names))
    buffer = io.BytesIO()
    try:
        message.serialize(buffer)
    except Exception as error:
        return (type(error).__name__, str(error))
    return ("written", buffer.getvalue())


if __name__ == "__main__":
    jobs = pickle.load(sys.stdin.buffer)
    answers = [answer(*job) if len(job) == 3 else attempt(*job) for job in jobs]
    pickle.dump(answers, sys.stdout.buffer, protocol=4)
