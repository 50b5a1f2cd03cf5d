"""What real roslaunch makes of launch files: nodes and parameters as JSON. Run by the system's Python.

roslaunch_peer.py FILE [name:=value ...]     one file
roslaunch_peer.py -                          a JSON list of such lists on standard input, a list of answers
"""

import json
import sys
from xmlrpc.client import Binary

import roslaunch.config
import roslaunch.xmlloader


def plain(value):
    return value.data.decode("latin-1") if isinstance(value, Binary) else value


def described(words):
    config = roslaunch.config.ROSLaunchConfig()
    loader = roslaunch.xmlloader.XmlLoader(resolve_anon=True)
    loader.ignore_unset_args = False
    loader.load(words[0], config, argv=words[1:], verbose=False)
    nodes = [
        {
            "package": node.package,
            "type": node.type,
            "name": node.name,
            "namespace": node.namespace,
            "args": node.args,
            "remaps": node.remap_args,
            "env": dict(node.env_args),
            "respawn": [node.respawn, node.respawn_delay],
            "required": node.required,
            "output": node.output or "log",
            "cwd": node.cwd,
            "prefix": node.launch_prefix or "",
            "machine": node.machine_name or "",
        }
        for node in [*config.nodes, *config.tests]
    ]
    return {
        "nodes": nodes,
        "params": {key: plain(param.value) for key, param in config.params.items()},
        "files": config.roslaunch_files,
        "cleared": config.clear_params,
        "machines": sorted(name for name in config.machines if name),
        "warnings": len(config.config_errors),
    }


def answered(words):
    try:
        return described(words)
    except Exception as error:
        return {"error": f"{type(error).__name__}: {error}"}


if sys.argv[1] == "-":
    json.dump([answered(words) for words in json.load(sys.stdin)], sys.stdout)
else:
    json.dump(described(sys.argv[1:]), sys.stdout)
