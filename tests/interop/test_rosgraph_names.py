"""Resolution, remapping and command lines: the same as real rosgraph and rospy."""

import itertools
import json
import random
from collections.abc import Callable
from typing import Any

from rosmini.core.names import (
    Remappings,
    canonicalize,
    is_legal_base_name,
    is_legal_name,
    is_remapping,
    join,
    namespace,
    resolve,
    resolve_for,
)
from rosmini.ros.rospy.aliases.rosgraph.names import load_mappings

from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros

THEIRS = """
import json, sys
import rosgraph.names, rospy.names, rospy.client
job = json.load(sys.stdin)
out = {"rospy": [], "rosgraph": [], "basic": [], "argv": [], "legal": [], "wrong": []}
def outcome(function, argument):
    try:
        return function(argument)
    except Exception as error:
        return type(error).__name__
for name in job["odd"]:
    legal = (rosgraph.names.is_legal_name, rosgraph.names.is_legal_base_name, rosgraph.names.namespace)
    out["legal"].append([outcome(f, name) for f in legal])
out["wrong"] = [rosgraph.names.load_mappings([word]) for word in job["wrong"]]
for node, rules, name in job["names"]:
    rospy.names.reload_mappings(["%s:=%s" % rule for rule in rules.items()])
    rospy.names.initialize_mappings(node)
    out["rospy"].append(rospy.names.resolve_name(name, node))
    out["rosgraph"].append(rosgraph.names.resolve_name(name, node))
    n = rosgraph.names
    out["basic"].append([n.namespace(name), n.canonicalize_name(name), n.ns_join(node, name)])
for argv in job["argvs"]:
    out["argv"].append([rosgraph.names.load_mappings(argv), rospy.client.load_command_line_node_params(argv),
                        rospy.client.myargv(argv), [rosgraph.names.is_legal_remap(a) for a in argv]])
print(json.dumps(out))
"""

NODES = ["/node", "/ns/node", "/a/b/c"]
RULES = [{}, {"chatter": "talk", "/odom": "ns/odom", "~cmd": "cmd"}, {"a": "b", "b": "a", "x/y": "~p"}]
NAMES = [
    "", "/", "~", "chatter", "/chatter", "~chatter", "ns/odom", "/odom", "~cmd", "a", "b", "x/y", "a//b/", "//a",
    "~/a", "~a//b",
]  # fmt: skip
ARGVS = [
    [
        "prog", "a:=b", "/x:=/y", "~p:=q", "_rate:=10", "__name:=n", "--flag", "plain", "x=1", "_s:=''",
        "_l:=[1, 2]", "_e:=1e5", "_f:=1.0e+5",
    ],
    [
        "prog", "_t:=true", "_empty:=", ":=b", "a:=", "-x:=y", "a b:=c", "2a:=b", "_d:={a: {b: 1}}", "_sp:= 5 ",
        "__ns:=foo", "_u:=two\nlines",
    ],
]  # fmt: skip


ODD = [
    *(
        "f//b", "/f//b", "//f", "~f//b", "//", "/f/", "f/b/", "~a~b", "a b", "1a", "_a", "\u00e9", "a\n", "b:=c",
    ),
    *(None, 1, []),
]  # fmt: skip
"""What is hardly a name, or none."""

WRONG = [
    *("foo:=bar:=baz", "-bar:=baz", "_x:=:=3", "/a:=b:=c", "__ns:=a:=b", "_p:=a:=b", "--x:=y", "a-b:=c"),
    *("a:=b\nc", "_p:=[1", "__ns:=a", "a:=b c"),
]
"""Command-line arguments, most of which are no remappings."""


def outcome(function: Callable[[Any], Any], argument: Any) -> Any:
    try:
        return function(argument)
    except Exception as error:
        return type(error).__name__


def test_names_resolve_as_in_real_ros() -> None:
    rng = random.Random(1)
    made = ["".join(rng.choice("~/ab_") for _ in range(rng.randint(1, 8))) for _ in range(300)]
    made = [name for name in made if "~" not in name[1:] and name[0] != "_"]
    table = [list(row) for row in itertools.product(NODES, RULES, NAMES + made)]
    job = json.dumps({"names": table, "argvs": ARGVS, "odd": ODD, "wrong": WRONG})
    need_ros(modules="rospy")
    done = run([SYSTEM_PYTHON, "-c", THEIRS], stdin=job, check=True)
    theirs = json.loads(done.stdout)
    ours: dict = {"rospy": [], "rosgraph": [], "basic": [], "argv": []}
    ours["legal"] = [
        [outcome(function, name) for function in (is_legal_name, is_legal_base_name, namespace)] for name in ODD
    ]
    ours["wrong"] = [load_mappings([word]) for word in WRONG]
    for node, rules, name in table:
        ours["rospy"].append(resolve(name, namespace(node), node, Remappings(rules)))
        ours["rosgraph"].append(resolve_for(name, node))
        ours["basic"].append([namespace(name), canonicalize(name), join(node, name)])
    for argv in ARGVS:
        found = Remappings.from_argv(argv)
        legal = [is_remapping(argument) for argument in argv]
        ours["argv"].append(
            [{**found.names, **found.special}, found.private_parameters, Remappings.other_arguments(argv), legal]
        )
    for kind, rows in theirs.items():
        labels = {"argv": ARGVS, "legal": ODD, "wrong": WRONG}.get(kind, table)
        assert [
            (kind, at, "real", a, "ours", b) for at, a, b in zip(labels, rows, ours[kind], strict=True) if a != b
        ] == []
