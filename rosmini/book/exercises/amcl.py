"""Checks of the exercises in the chapter amcl."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.drives import Drive, navigation
from rosmini.book.trials import TurtleTrial
from rosmini.msgs.geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped

PLACES = ((1.0, 0.5, math.pi / 2), (-2.0, 3.0, -0.6))
"""Poses of the robot in the two trials of exercise here_i_am."""
SURE = 0.15
"""Required standard deviations of x and y there [m]."""
STATION = (0.9, 2.6, 3.14)
"""Pose of the robot that drives after that."""
LOST = (1.2, -0.9, 0.0)
"""Pose of the robot in exercise find_yourself."""
CHILDS_ROOM = (-2.2, -1.2)
SURE_ENOUGH = 0.2
"""Standard deviation of x and y below which that robot may drive [m]."""
FINDS = {
    "min_particles": 100, "max_particles": 10000, "kld_err": 0.01, "odom_model_type": "diff-corrected",
    "odom_alpha1": 0.1, "odom_alpha2": 0.1, "odom_alpha3": 0.1, "odom_alpha4": 0.1,
    "laser_model_type": "likelihood_field_prob", "laser_z_hit": 0.95, "laser_z_rand": 0.05, "laser_sigma_hit": 0.8,
    "update_min_d": 0.06, "update_min_a": 0.06, "resample_interval": 8,
}  # fmt: skip
"""Parameters with which amcl finds lost robots."""
ELSEWHERE: dict[str, Any] = {
    "localization": "amcl", "initial_pose_x": -3.0, "initial_pose_y": 1.0, "initial_pose_a": 0.0,
}  # fmt: skip
"""Arguments with which amcl begins where the robot is not."""


@exercise("systematic", praise="With one random number, each particle gets its share, give or take one.")
def systematic(answer: Any) -> None:
    """Resampling with one random number."""
    rng = np.random.default_rng(1)
    for count in (4, 50):
        weights = rng.random(count) + 0.01
        weights[0] = 3.0
        shares = count * weights / weights.sum()
        for u in (0.0, 0.4, 0.999):
            found = np.asarray(answer(weights.copy(), u))
            expect(
                found.shape == (count,),
                f"For {count} particles the result has shape {found.shape}, not ({count},).",
                "return one index for each particle",
            )
            expect(
                np.issubdtype(found.dtype, np.integer) and ((found >= 0) & (found < count)).all(),
                "The result contains values that are not indices of particles.",
                "np.searchsorted returns whole numbers",
            )
            drawn = np.bincount(found, minlength=count)
            off = int(np.argmax(abs(drawn - shares)))
            expect(
                abs(drawn[off] - shares[off]) < 1 + 1e-9,
                f"A particle that has {shares[off]:.1f} of {count} shares was drawn {drawn[off]} times.",
                "compare the marks (i + u) / n with the cumulative sum of the weights, np.cumsum",
            )
            marks = (np.arange(count) + u) / count
            wanted = np.searchsorted(np.cumsum(weights / weights.sum()), marks, side="right")
            expect(
                np.count_nonzero(found != wanted) <= 1,
                f"With u = {u} it drew particles other than those that the marks (i + u) / n select.",
                "u is an argument; draw no other random number",
            )


@exercise("here_i_am", praise="amcl knows where the robot is, and it drives.")
def here_i_am(answer: Script) -> Any:
    """A script that publishes its parameters as an initial pose, with which a robot then drives to its goal."""
    for x, y, yaw in PLACES:
        with TurtleTrial(None) as trial:
            heard: list[Any] = []
            trial.graph.node("amcl").subscriber("initialpose", PoseWithCovarianceStamped, heard.append)
            trial.start(answer, f"_x:={x}", f"_y:={y}", f"_yaw:={yaw}")
            trial.run(10.0)
            expect(
                bool(heard),
                "There was no message on initialpose within 10 s.",
                "wait for a subscriber after rospy.Publisher, or latch the topic",
            )
            _check_pose(heard[-1], (x, y, yaw))
    x, y, yaw = STATION
    with Drive(navigation(STATION, {}, **ELSEWHERE)) as drive:
        drive.start(answer, f"_x:={x}", f"_y:={y}", f"_yaw:={yaw}")
        drive.run(5.0)
        drive.expect_arrival((-1.0, 1.0, 3.14), 40.0, "publish the pose once: amcl begins there again each time")
        return drive.view()


def _check_pose(message: Any, wanted: tuple[float, float, float]) -> None:
    x, y, yaw = wanted
    frame, pose = message.header.frame_id.lstrip("/"), message.pose.pose
    expect(frame == "map", f"Its frame is {frame!r}, not 'map': amcl ignores it.", "set header.frame_id")
    here = pose.position.x, pose.position.y
    expect(
        math.dist(here, (x, y)) < 1e-3,
        f"The pose is ({here[0]:.2f}, {here[1]:.2f}); the parameters are ({x:.2f}, {y:.2f}).",
        'read them with rospy.get_param("~x")',
    )
    q = pose.orientation
    expect(
        abs(math.hypot(q.z, q.w) - 1) < 1e-3 and abs(math.remainder(2 * math.atan2(q.z, q.w) - yaw, math.tau)) < 1e-3,
        "The orientation does not match the parameter yaw.",
        "z is sin(yaw / 2), w is cos(yaw / 2)",
    )
    covariance = np.reshape(message.pose.covariance, (6, 6))
    variances = np.diag(covariance)[[0, 1, 5]]
    expect(
        (variances > 0).all(),
        f"The variances of x, y and heading are {variances.round(3).tolist()}: all particles would be at one point.",
        "set the elements 0, 7 and 35 of the covariance",
    )
    expect(
        np.allclose(np.sqrt(variances[:2]), SURE, atol=1e-3),
        f"x and y have standard deviations of {np.sqrt(variances[:2]).round(3).tolist()} m, not {SURE}.",
        "a covariance contains squares of standard deviations",
    )
    rest = covariance.copy()
    rest[[0, 1, 5], [0, 1, 5]] = 0.0
    expect(not rest.any(), "Elements of the covariance that should be 0 are not.", "set only 0, 7 and 35")


@exercise("find_yourself", gaps=2, praise="The robot finds itself, and then delivers.")
def find_yourself(answer: Script) -> Any:
    """A script that calls global_localization, wanders until amcl is sure, and sends the goal once."""
    with Drive(navigation(LOST, FINDS, "amcl", **ELSEWHERE)) as drive:
        lost: list[float] = []
        sure: list[float] = []
        goals: list[float] = []
        now = drive.graph.now

        def on_pose(message: Any) -> None:
            spread = math.sqrt(max(message.pose.covariance[0], message.pose.covariance[7]))
            if spread > 1.0:
                lost.append(now().to_sec())
            elif lost and spread < SURE_ENOUGH:
                sure.append(now().to_sec())

        judge = drive.graph.node("judge")
        judge.subscriber("amcl_pose", PoseWithCovarianceStamped, on_pose)
        judge.subscriber("move_base_simple/goal", PoseStamped, lambda _: goals.append(now().to_sec()))
        begin = now().to_sec()
        drive.start(answer)
        while now().to_sec() < begin + 90.0 and not drive.results:
            drive.run(1.0)
        expect(bool(lost), "amcl never began with particles everywhere.", "call the service global_localization")
        expect(bool(sure), "amcl was not sure of the pose within 90 s.", "drive as wander.py does until amcl is sure")
        expect(bool(goals), "There was no goal on move_base_simple/goal within 90 s.", "send it in on_pose")
        expect(len(goals) == 1, f"There were {len(goals)} goals, not one.", "remember that the goal was sent")
        expect(
            goals[0] >= sure[0],
            f"The goal was sent {sure[0] - goals[0]:.0f} s before amcl was sure of the pose.",
            "both variances must be less than 0.2 squared",
        )
        x, y, _ = drive.robot.truth()
        off = math.dist((x, y), CHILDS_ROOM)
        expect(
            bool(drive.results) and off < 0.3,
            f"move_base did not finish its goal, {off:.1f} m from the robot.",
            "after the goal was sent, publish no more commands: move_base drives",
        )
        return drive.view()
