"""Wrong answers to the exercises of the chapter Launch files: right ones with a fault put in."""

from __future__ import annotations

from .file_system import wrong

FLEET = """
<launch>
  <arg name="speed" default="0.2"/>
  <include file="$(find notebook)/launch/world.launch"/>
  <include file="$(find notebook)/launch/robot.launch">
    <arg name="name" value="amy"/>
    <arg name="speed" value="$(arg speed)"/>
  </include>
  <include file="$(find notebook)/launch/robot.launch">
    <arg name="name" value="bob"/>
    <arg name="speed" value="$(arg speed)"/>
  </include>
  <include file="$(find notebook)/launch/robot.launch">
    <arg name="name" value="cleo"/>
    <arg name="speed" value="0.1"/>
  </include>
</launch>
"""

REPAIRED = """
<launch>
  <arg name="speed" default="0.2"/>
  <include file="$(find notebook)/launch/world.launch"/>
  <group ns="amy">
    <node pkg="notebook" type="patrol.py" name="patrol">
      <param name="speed" value="$(arg speed)"/>
    </node>
    <param name="card" value="0042" type="str"/>
  </group>
  <node pkg="notebook" type="patrol.py" name="bob_patrol">
    <remap from="cmd_vel" to="bob/cmd_vel"/>
    <remap from="scan" to="bob/scan"/>
    <param name="speed" value="$(arg speed)"/>
  </node>
  <param name="bob/card" value="0043" type="str"/>
</launch>
"""

NIGHT = """
<launch>
  <arg name="night" default="false"/>
  <include file="$(find notebook)/launch/world.launch"/>
  <group ns="amy" unless="$(arg night)">
    <node pkg="notebook" type="patrol.py" name="patrol" respawn="true"/>
  </group>
  <group ns="bob">
    <node pkg="notebook" type="patrol.py" name="patrol" respawn="true">
      <param name="speed" value="$(eval 0.05 if night else 0.2)"/>
    </node>
  </group>
</launch>
"""

MISTAKES = {
    "fleet": [
        lambda: ["robot.launch"],
        wrong(FLEET, '<arg name="speed" default="0.2"/>\n  <inc', '<arg name="speed" value="0.2"/>\n  <inc'),
        wrong(FLEET, '"amy"/>\n    <arg name="speed" value="$(arg speed)"/>', '"amy"/>'),
        wrong(FLEET, 'value="0.1"', 'value="$(arg speed)"'),
        wrong(FLEET, '<include file="$(find notebook)/launch/world.launch"/>'),
        wrong(FLEET, '"cleo"', '"bob"'),
        wrong(FLEET, "</launch>"),
    ],
    "repaired_launch": [
        wrong(REPAIRED, '<arg name="speed" default', '<arg name="speed" value'),
        wrong(REPAIRED, ' type="str"/>\n  </group>', "/>\n  </group>"),
        wrong(REPAIRED, 'from="cmd_vel" to="bob/cmd_vel"', 'from="bob/cmd_vel" to="cmd_vel"'),
        wrong(REPAIRED, '<group ns="amy">', '<group ns="amy"/><group>'),
        wrong(REPAIRED, '<param name="speed" value="$(arg speed)"/>\n    </node>', "</node>"),
    ],
    "night_shift": [
        wrong(NIGHT, ' unless="$(arg night)"'),
        wrong(NIGHT, "unless", "if"),
        wrong(NIGHT, "0.05 if night", "0.2 if night"),
        wrong(NIGHT, '"patrol" respawn="true">', '"patrol">'),
        wrong(NIGHT, '"patrol" respawn="true">', '"patrol" respawn="true" respawn_delay="20">'),
        wrong(NIGHT, '<arg name="night" default="false"/>', '<arg name="night"/>'),
    ],
}
