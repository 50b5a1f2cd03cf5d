#!/usr/bin/env python
import random

import rospy

import config

random.seed(config.SEED)
rospy.init_node("node_" + config.SIDE)
rate = rospy.Rate(500)
numbers = []
for _ in range(3):
    numbers.append(random.randint(0, 999))
    rate.sleep()


def late():
    from config import SIDE

    return SIDE


print(late(), numbers)
