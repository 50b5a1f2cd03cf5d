"""What real roslaunch makes of a launch file: its nodes and parameters as JSON. Run by the system's Python."""

import json
import sys

import roslaunch.config
import roslaunch.xmlloader

config = roslaunch.config.ROSLaunchConfig()
loader = roslaunch.xmlloader.XmlLoader(resolve_anon=True)
loader.load(sys.argv[1], config, argv=sys.argv[2:], verbose=False)
nodes = [
    {
        "package": node.package,
        "type": node.type,
        "name": node.name,
        "namespace": node.namespace,
        "args": node.args,
        "remaps": node.remap_args,
    }
    for node in config.nodes
]
json.dump({"nodes": nodes, "params": {key: param.value for key, param in config.params.items()}}, sys.stdout)
