"""A script for rosgraph, roslib.names and rosparam's command line. Run by the real ones and by ours."""

import io
import json
import os
import sys
import tempfile

import rosgraph
import rosgraph.names
import roslib.names
import rosparam

facts = {
    "constants": [rosgraph.ROS_MASTER_URI, rosgraph.ROS_IP, rosgraph.ROS_HOSTNAME, rosgraph.ROS_NAMESPACE,
        rosgraph.ROS_IPV6],
    "defaults": [rosgraph.rosenv.DEFAULT_MASTER_PORT, rosgraph.rosenv.DEFAULT_MASTER_URI],
    "online": rosgraph.is_master_online(),
}  # fmt: skip
facts["script names"] = [
    rosgraph.names.script_resolve_name("tool", name) for name in ("", None, "a", "/a", "~a", "~a/b", "a/b", "~")
]
names = roslib.names
facts["separators"] = [names.SEP, names.REMAP, names.ANYTYPE]


def command(*arguments):
    """What rosparam prints, how it ends, and whether it complains."""
    before, code = (sys.stdout, sys.stderr), None
    sys.stdout, sys.stderr = io.StringIO(), io.StringIO()
    try:
        rosparam.yamlmain(["rosparam", *arguments])
    except SystemExit as end:
        code = end.code
    finally:
        out, err = sys.stdout.getvalue(), sys.stderr.getvalue()
        sys.stdout, sys.stderr = before
    out = out.replace(folder, "F")
    return [out if code in (None, 1) else bool(out), code, bool(err)]


folder = tempfile.mkdtemp()
path = os.path.join(folder, "dump.yaml")
facts["commands"] = [
    [" ".join(line).replace(folder, "F"), [*command(*line)]]
    for line in [
        ["set", "/p/int", "5"], ["set", "/p/negative", "-5"], ["set", "/p/float", "-1.5"], ["set", "/p/text", "hello"],
        ["set", "/p/empty", ""],
        ["set", "/p/quoted", "'5'"], ["set", "/p/list", "[1, two, 3.0]"], ["set", "/p/tree", "{a: 1, b: {c: x}}"],
        ["set", "-v", "/p/flag", "true"],
        ["get", "/p/int"], ["get", "/p/negative"], ["get", "/p/float"], ["get", "/p/text"], ["get", "/p/empty"],
        ["get", "/p/quoted"],
        ["get", "/p/list"], ["get", "/p/tree"], ["get", "-p", "/p/tree"], ["get", "-p", "/p/text"], ["get", "-p", "/p"],
        ["get", "/p"],
        ["get", "-v", "p/int"], ["get", "/nothing"], ["get"], ["get", "a", "b"], ["set", "/p/int"], ["set"],
        ["list", "/p"], ["list", "/p/tree"],
        ["list", "a", "b"], ["get", "-p", "/p"], ["dump", path, "/p"],
        ["delete", "/p/tree"], ["list", "/p"],
        ["delete", "-v", "/p/int"], ["delete", "/p/int"], ["delete"], ["load", path, "/q"], ["list", "/q"],
        ["get", "/q/tree/b"],
        ["load", "-v", path, "again"], ["get", "/again/int"], ["load"],
    ]
]  # fmt: skip
with open(path, encoding="utf-8") as dumped:
    facts["dumped"] = dumped.read()

print(json.dumps(facts))
