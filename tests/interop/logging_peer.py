"""Run by real ROS and by rosmini: loggers, their levels, and what goes to the log file."""

import json

import rospy
from roscpp.srv import GetLoggers, SetLoggerLevel

rospy.init_node("peer")
loggers = rospy.ServiceProxy("/peer/get_loggers", GetLoggers)
set_level = rospy.ServiceProxy("/peer/set_logger_level", SetLoggerLevel)
results = []


def levels():
    found = {logger.name: logger.level for logger in loggers().loggers}
    results.append(
        {
            name: level
            for name, level in found.items()
            if name.startswith(("rosout", "rospy.internal", "rospy.core", "mine"))
        }
    )


levels()
rospy.loginfo("an info %d", 1)
rospy.logdebug("hidden")
rospy.logwarn("two\nlines")
rospy.logerr("wrong")
rospy.logfatal("over: größer")
rospy.loginfo("named", logger_name="mine.deep")
rospy.core.rospyinfo("internal %s", "info")
rospy.core.rospywarn("internal warning")
rospy.core.rospydebug("hidden")
levels()
set_level("rosout.mine", "debug")
rospy.logdebug("shown", logger_name="mine")
rospy.logdebug("shown deep", logger_name="mine.deep")
levels()
set_level("rosout.mine.deep", "WARN")
set_level("rosout", "Error")
rospy.loginfo("hidden", logger_name="mine.deep")
rospy.logwarn("hidden")
rospy.logwarn("shown", logger_name="mine.deep")
rospy.logerr("shown")
levels()
set_level("rospy.internal", "ERROR")
rospy.core.rospywarn("hidden")
rospy.core.rospyerr("internal error")
set_level("rosout", "FATAL")
rospy.logerr("hidden")
levels()
print(json.dumps(results, sort_keys=True))
