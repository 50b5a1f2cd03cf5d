"""A script for dynamic_reconfigure that tells what it does, as JSON on its last line. Run by the real one and by ours.

Its argument is the module that dynamic_reconfigure's own Test.cfg became; it is read as it is.
"""

import json
import sys
import types

import dynamic_reconfigure
import rospy
from dynamic_reconfigure import (
    DynamicReconfigureCallbackException,
    DynamicReconfigureException,
    DynamicReconfigureParameterException,
)
from dynamic_reconfigure.client import Client
from dynamic_reconfigure.msg import Config, ConfigDescription, DoubleParameter, IntParameter
from dynamic_reconfigure.server import Server
from dynamic_reconfigure.srv import Reconfigure

rospy.init_node("peer")
TestConfig = types.ModuleType("TestConfig")
with open(sys.argv[1], encoding="utf-8") as source:
    exec(source.read(), TestConfig.__dict__)
facts = {"types": [Config._md5sum, ConfigDescription._md5sum, Reconfigure._md5sum]}


def wait(condition, what):
    for _ in range(40000):
        if condition():
            return
        rospy.rostime.wallsleep(0.005)
    raise RuntimeError("waited in vain for " + what)


def values(config):
    return {key: value for key, value in config.items() if key != "groups"}


def states(tree):
    """Number, parent and state of each group, by name.

    Real ones have no type there: it is not in the messages with values.
    """
    found = {tree["name"]: [tree["id"], tree["parent"], tree["state"]]}
    for inner in tree["groups"].values():
        found.update(states(inner))
    return found


def listed(tree):
    """The type and the names of the parameters of each group that a client hears of."""
    found = {tree["name"]: [tree["type"]] + [one["name"] for one in tree["parameters"]]}
    for inner in tree["groups"].values():
        found.update(listed(inner))
    return found


calls = []


def callback(config, level):
    calls.append([values(config), states(config["groups"]), level])
    assert config.int_ == config["int_"]
    if config["str_"] == "refuse":
        raise ValueError("no")
    if config["str_"] == "upper me":
        config["str_"] = "UPPER"
    return config


rospy.set_param("~int_", 99)
rospy.set_param("~double_", 1.5)
server = Server(TestConfig, callback)
facts["first call"] = dict(zip(["values", "groups", "level"], calls[0], strict=True))
facts["on the server"] = {key: rospy.get_param("~" + key) for key in values(server.config)}
updates, descriptions = [], []
rospy.Subscriber("~parameter_updates", Config, updates.append)
rospy.Subscriber("~parameter_descriptions", ConfigDescription, descriptions.append)
wait(lambda: updates and descriptions, "the latched messages")
facts["description"] = [
    [
        [group.name, group.type, group.id, group.parent]
        + [[p.name, p.type, p.level, p.description, p.edit_method] for p in group.parameters]
        for group in descriptions[0].groups
    ],
    *[
        [[one.name, str(one.value)] for field in ("bools", "ints", "strs", "doubles") for one in getattr(part, field)]
        for part in (descriptions[0].max, descriptions[0].min, descriptions[0].dflt)
    ],
]


def told(message):
    return [
        sorted([one.name, one.value] for one in getattr(message, field))
        for field in ("bools", "ints", "strs", "doubles")
    ] + [sorted([group.name, group.state, group.id, group.parent] for group in message.groups)]


facts["first update"] = told(updates[0])

heard, described = [], []
client = Client("peer", 10, heard.append, described.append)
facts["configuration"] = values(client.get_configuration(10))
facts["described"] = [{key: str(one[key]) for key in sorted(one)} for one in client.get_parameter_descriptions(10)]
wait(lambda: described, "the description")
facts["the callback's"] = [one["name"] for one in described[0]]
facts["groups"] = [listed(client.get_group_descriptions(10)), states(client.get_group_descriptions(10))]

facts["changes"] = {}
for changes in (
    {"int_": 5},
    {"int_": 1000, "double_": -99},
    {"int_": "7", "double_": "2.5", "str_": "hello", "bool_": "yes"},
    {"bool_": "nonsense", "int_enum_": "Large"},
    {"int_enum_": "small", "double_no_minmax": 1e9},
    {"str_": "upper me"},
    {"int_": 7.9},
    {},
    {"mstr_": "\u00fcber"},
    {"group1_int": -3},  # states of groups cannot be set: the real Python server fails at them
):
    before = len(updates)
    answer = client.update_configuration(dict(changes))
    wait(lambda before=before: len(updates) > before, "an update")
    facts["changes"][str(changes)] = {
        "answer": values(answer),
        "call": calls[-1][0],
        "level": calls[-1][2],
        "update": told(updates[-1]),
        "groups": states(answer["groups"]),
    }
wait(lambda: heard and heard[-1]["group1_int"] == -3, "the client's callback")
facts["heard"] = values(heard[-1])

facts["errors"] = {}
for name, changes in {"unknown": {"nonsense": 1}, "no number": {"int_": "many"}, "refused": {"str_": "refuse"}}.items():
    try:
        client.update_configuration(changes)
    except DynamicReconfigureParameterException:
        facts["errors"][name] = "parameter"
    except DynamicReconfigureCallbackException:
        facts["errors"][name] = "callback"
facts["after errors"] = [values(server.config)["str_"], rospy.get_param("~str_")]
facts["tree"] = [
    issubclass(one, DynamicReconfigureException)
    for one in (DynamicReconfigureParameterException, DynamicReconfigureCallbackException)
]

by_server = server.update_configuration({"int_": -1000, "bool_": False})
facts["by the server"] = [by_server["int_"], by_server["bool_"], calls[-1][2]]
service = rospy.ServiceProxy("~set_parameters", Reconfigure)
request = Config(ints=[IntParameter("int_", 3)], doubles=[DoubleParameter("double_", 11.0)])
facts["raw"] = [told(service(request).config)[1:4], calls[-1][2]]

wait(lambda: client.config["int_"] == 3, "the client's configuration")
late = []
client.config_callback = late.append
facts["late"] = [values(one)["int_"] for one in late[:1]]
client.config_callback = None
client.close()

facts["joined levels"] = []
for changes in (
    {"int_": 7, "double_": 2.5},
    {"int_": 7},
    {"int_": 8, "str_": "s", "bool_": True},
    {},
    {"bool_": False},
):
    server.update_configuration(changes)
    facts["joined levels"].append(calls[-1][2])
facts["found"] = [
    dynamic_reconfigure.find_reconfigure_services(),
    sorted(dynamic_reconfigure.get_parameter_names(TestConfig)),
]
client.set_config_callback(print)
facts["callbacks"] = [
    client.get_config_callback() is print,
    client.config_callback is print,
    client.get_description_callback() is client.description_callback,
]
client.set_config_callback(None)

inner = Server(TestConfig, lambda config, level: config, "inner/part")
facts["namespace"] = sorted(topic for topic, _ in rospy.get_published_topics() if topic.startswith("/peer/inner"))
facts["namespace"].append(rospy.get_param("/peer/inner/part/str_"))
other = Client("/peer/inner/part", timeout=200)
facts["namespace"].append(other.update_configuration({"int_": 4})["int_"])
try:
    Client("nobody", timeout=0.2)
except rospy.ROSException:
    facts["nobody"] = "ROSException"
try:
    Server(TestConfig, lambda config, level: None, "bad")
except DynamicReconfigureCallbackException:
    facts["returns nothing"] = "callback"
print(json.dumps(facts))
