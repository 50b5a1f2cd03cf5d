"""`rosmini rostopic`: the verbs of ROS's tool, with its options and output (http://wiki.ros.org/rostopic).

In a terminal they act on the graph of the Master at ``ROS_MASTER_URI``, and those that listen or publish run until
Ctrl-C. In Python they act on a graph of this process, for some of its time, and return data:
``TOOL.run("echo", "-n", 3, "/scan/ranges[0]", graph=graph).messages``.
"""

from __future__ import annotations

from rosmini.core.verbs import Tool

from . import rostopic_echo, rostopic_list, rostopic_pub, rostopic_rates

TOOL = Tool(
    "rostopic",
    "topics: list them, show their messages and rates; publish on one",
    example="echo",
    purpose="printing information about ROS Topics",
)

TOOL.verb("display bandwidth used by topic", name="bw", parser=rostopic_rates.bw_parser, takes="topic")(
    rostopic_rates.bw
)
TOOL.verb(
    "display delay of topic from timestamp in header", name="delay", parser=rostopic_rates.delay_parser, takes="topic"
)(rostopic_rates.delay)
TOOL.verb("print messages to screen", name="echo", parser=rostopic_echo.echo_parser, takes="topic")(rostopic_echo.echo)
TOOL.verb("find topics by type", name="find", parser=rostopic_list.find_parser, only_asks=True, takes="msg")(
    rostopic_list.find
)
TOOL.verb("display publishing rate of topic    ", name="hz", parser=rostopic_rates.hz_parser, takes="topic")(
    rostopic_rates.hz
)
TOOL.verb(
    "print information about active topic", name="info", parser=rostopic_list.info_parser, only_asks=True, takes="topic"
)(rostopic_list.info)
TOOL.verb("list active topics", name="list", parser=rostopic_list.list_parser, only_asks=True, takes="topic")(
    rostopic_list.list_
)
TOOL.verb("publish data to topic", name="pub", parser=rostopic_pub.pub_parser, takes="topic msg value")(
    rostopic_pub.pub
)
TOOL.verb("print topic or field type", name="type", parser=rostopic_list.type_parser, only_asks=True, takes="topic")(
    rostopic_list.type_
)
