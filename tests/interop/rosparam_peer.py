"""Run by real ROS and by rosmini: what rosparam does with YAML and with the Parameter Server, as JSON."""

import io
import json
import os
import sys
import tempfile

import rosgraph
import rosparam
import rospy

YAML = """
whole: 5
real: 5.0
exponent: 1.0e+5
no_exponent: 1e5
truth: yes
switch: off
quoted: "5"
octal: 010
clock: 1:30
degrees: !degrees 90
short: deg(180)
spaced: deg( 45 )
radians: rad(2*pi)
half: rad(-pi/2)
explicit: !radians (1+1)*pi
no_angle: "rad(pi)"
text: deg
list: [1, 2.5, three, [true, {a: 1}]]
tree: {b: {c: 1, d: "two"}, a: []}
empty: {}
folded: >
  one
  two
literal: |
  one
  two
---
_ns: inner
x: 1
---
_ns: /outer
x: 2
"""

results = {}


def attempt(name, function):
    try:
        results[name] = function()
    except (rosparam.RosParamException, rosgraph.MasterException) as error:
        names = [
            kind.__name__ for kind in (rosparam.RosParamException, rosgraph.MasterError) if isinstance(error, kind)
        ]
        results[name] = [*names, str(error) if names == ["MasterError"] else ""]


def mine():
    return {name: rosparam.get_param(name) for name in rosparam.list_params("/mine")}


def dumped(name):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "dump.yaml")
        rosparam.dump_params(path, name)
        with open(path, encoding="utf-8") as file:
            return file.read()


def printed(function, *arguments, **options):
    before, sys.stdout = sys.stdout, io.StringIO()
    try:
        function(*arguments, **options)
        return sys.stdout.getvalue()
    finally:
        sys.stdout = before


def upload(text, ns):
    for values, namespace in rosparam.load_str(text, "peer", default_namespace=ns):
        rosparam.upload_params(namespace, values)


rospy.init_node("peer")
attempt("loaded", lambda: rosparam.load_str(YAML, "peer", default_namespace="/mine"))
attempt("default namespace", lambda: rosparam.load_str("a: 1", "peer"))
attempt("list of documents", lambda: rosparam.load_str("[1, 2]\n---\n[3]", "peer"))
attempt("upload", lambda: upload(YAML, "/mine"))
attempt("server", mine)
attempt("outer", lambda: rosparam.get_param("/outer"))
attempt("dump", lambda: dumped("/mine"))
attempt("dump one", lambda: dumped("/mine/list"))
attempt("dump printed", lambda: printed(rosparam.dump_params, None, "/mine/tree"))
attempt("verbose upload", lambda: printed(rosparam.upload_params, "/v", {"a": 1, "b": {"c": "x"}}, verbose=True))
attempt(
    "verbose load", lambda: printed(rosparam.load_str, "_ns: x\na: 1", "peer", default_namespace="/mine", verbose=True)
)
attempt("print", lambda: printed(rosparam.print_params, {"a": [1], "b": {"c": "x"}, "d": {}}, "/p"))
rosparam.set_param("/merge", "{a: 1, l: [1, 2, 3]}")
rosparam.set_param("/merge", "{b: 2, l: [4]}")
attempt("merged", lambda: rosparam.get_param("/merge"))
rosparam.set_param("/merge", "{}")
attempt("merged with nothing", lambda: rosparam.get_param("/merge"))
rosparam.set_param("/merge/a", "{deep: 1}")
attempt("a value gives way", lambda: rosparam.get_param("/merge"))
rospy.set_param("/merge", {"c": 3})
attempt("replaced by a node", lambda: rosparam.get_param("/merge"))
rosparam.set_param_raw("/raw", {"x": {"y": [1, {"z": 2}]}, "w": "deg(90)"})
attempt("raw", lambda: rosparam.get_param("/raw"))
attempt("list", lambda: [rosparam.list_params(ns) for ns in ("/raw", "raw/", "/raw/w", "/ra", "/raw/x")])
attempt("deleted", lambda: [rosparam.delete_param("/raw/x"), rosparam.list_params("/raw")])
attempt("delete again", lambda: rosparam.delete_param("/raw/x"))
attempt("verbose delete", lambda: printed(rosparam.delete_param, "/raw", verbose=True))
attempt("get nothing", lambda: rosparam.get_param("/nothing"))
attempt("number as root", lambda: rosparam.upload_params("/", 5))
attempt("keys", lambda: rosparam.set_param("/keys", "{1: one}"))
attempt("angle", lambda: rosparam.load_str("a: deg(north)", "peer"))
attempt("no file", lambda: rosparam.load_file("/no/such/file.yaml"))
attempt("search", lambda: [rospy.search_param("merge"), rospy.has_param("/merge/c"), rospy.get_param("/merge/c")])
attempt("constants", lambda: [rosparam.NAME, rosparam.NS])
attempt("verbose root", lambda: printed(rosparam.delete_param, "/", verbose=True))
attempt("nothing left", lambda: rosparam.list_params("/"))
print(json.dumps(results))
