#!/usr/bin/env python3
"""A node whose parameters can be changed while it runs."""

import rospy
import TunedConfig
from dynamic_reconfigure.server import Server


def callback(config, level):
    print("level", level, "speed", config.speed, config["lights"])
    return config


rospy.init_node("tuned")
server = Server(TunedConfig, callback)
rospy.spin()
