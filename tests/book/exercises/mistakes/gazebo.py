"""Wrong answers to the exercises of the chapter Gazebo: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

BARREL = """
import rospy
from gazebo_msgs.srv import SpawnModel
from geometry_msgs.msg import Point, Pose

BARREL = '''<sdf version="1.6"><model name="barrel"><link name="wood">
  <pose>0 0 0.3 0 0 0</pose>
  <inertial>
    <mass>3</mass>
    <inertia><ixx>0.12</ixx><iyy>0.12</iyy><izz>0.06</izz></inertia>
  </inertial>
  <collision name="solid">
    <geometry><cylinder><radius>0.2</radius><length>0.6</length></cylinder></geometry>
    <surface><friction><ode><mu>0.23</mu><mu2>0.23</mu2></ode></friction></surface>
  </collision>
</link></model></sdf>'''

rospy.init_node("barrel")
rospy.wait_for_service("/gazebo/spawn_sdf_model")
spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
spawn("barrel", BARREL, "", Pose(position=Point(1.0, 0.0, 0.0)), "")
"""

FRICTION = """
import rospy
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import GetModelState, GetPhysicsProperties, SetModelState

SPEED = 2.0


def measure():
    before = get_state("thing", "").pose
    state = ModelState(model_name="thing", pose=before)
    state.twist.linear.x = SPEED
    set_state(state)
    rospy.sleep(10)
    way = get_state("thing", "").pose.position.x - before.position.x
    return SPEED**2 / (2 * -get_physics().gravity.z * way)


rospy.init_node("friction")
rospy.wait_for_service("/gazebo/set_model_state")
get_state = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)
set_state = rospy.ServiceProxy("/gazebo/set_model_state", SetModelState)
get_physics = rospy.ServiceProxy("/gazebo/get_physics_properties", GetPhysicsProperties)
rospy.set_param("/mu", measure())
"""

LEASH = solution("gazebo", "leash")


def _with(script: str, old: str, new: str) -> Callable[[], Script]:
    assert old in script
    return lambda: Script("answer.py", script.replace(old, new))


MISTAKES = {
    "barrel": [
        _with(BARREL, "0 0 0.3 0", "0 0 0 0"),
        _with(BARREL, "0 0 0.3 0", "0 0 0.6 0"),
        _with(BARREL, "<izz>0.06", "<izz>0.12"),
        _with(BARREL, "<radius>0.2</radius>", "<radius>0.4</radius>"),
        _with(BARREL, "<cylinder><radius>0.2</radius><length>0.6</length></cylinder>", "<box><size>1 1 1</size></box>"),
        _with(BARREL, "collision", "visual"),
        _with(BARREL, '<link name="wood">', '<static>true</static><link name="wood">'),
        _with(BARREL, "<mass>3", "<mass>5"),
        _with(BARREL, "<mu>0.23", "<mu>0.5"),
        _with(BARREL, "<mu>0.23", "<mu>0.05"),
        _with(BARREL, 'spawn("barrel"', 'spawn("tin"'),
        _with(BARREL, "</inertial>", ""),
    ],
    "friction": [
        _with(FRICTION, "2 * -get", "-get"),
        _with(FRICTION, "-get_physics().gravity.z", "9.8"),
        _with(FRICTION, "rospy.sleep(10)", "rospy.sleep(0.5)"),
        _with(FRICTION, "SPEED**2 /", "SPEED /"),
        _with(FRICTION, "return ", ""),
        _with(FRICTION, "return ", "return 0.4 #"),
        _with(FRICTION, '"/mu"', '"/friction"'),
        _with(FRICTION, "measure())", "str(measure()))"),
    ],
    "leash": [
        _with(LEASH, "> 1.0", "> 2.0"),
        _with(LEASH, "> 1.0", "> 0.5"),
        _with(LEASH, "home = home or pose", "home = pose"),
        _with(LEASH, "pose=home", "pose=ModelState().pose"),
        _with(LEASH, "math.hypot(x, y)", "abs(x)"),
        _with(LEASH, 'ROBOT = "turtlebot3_burger"', 'ROBOT = "crate"'),
        _with(LEASH, "        set_state(", "        str("),
        _with(LEASH, "pose=home", "pose=pose"),
    ],
}
