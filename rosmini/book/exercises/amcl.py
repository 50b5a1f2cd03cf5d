"""Checks of the exercises in the chapter amcl."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rosmini.book.checks import Script, exercise, expect, expect_number
from rosmini.book.trials import TurtleTrial
from rosmini.msgs.geometry_msgs.msg import PoseWithCovarianceStamped

PLACES = ((1.0, 0.5, math.pi / 2), (-2.0, 3.0, -0.6))
"""Poses of the robot in the two trials of exercise here_i_am."""
SURE = 0.15
"""Required standard deviations of x and y there [m]."""


@exercise("effective", praise="This is the number of particles that still count.")
def effective(answer: Any) -> None:
    """The effective number of particles, also if the weights do not add up to one."""
    for weights, wanted in (([0.25] * 4, 4.0), ([1.0, 0.0, 0.0], 1.0), ([2.0, 2.0, 4.0], 8 / 3)):
        found = expect_number(answer(np.array(weights)), "number of particles")
        hint = "divide the weights by their sum, then return 1 over the sum of their squares"
        expect(
            math.isclose(found, wanted, rel_tol=1e-6),
            f"For the weights {weights} it returned {found:.3f}, not {wanted:.3f}.",
            hint,
        )


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
                f"For {count} particles the result has the shape {found.shape}, not ({count},).",
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
                f"With u = {u} it drew different particles than the marks (i + u) / n select.",
                "u is an argument; draw no other random number",
            )


@exercise("here_i_am", praise="amcl would start its search for the robot at this pose.")
def here_i_am(answer: Script) -> None:
    """A script that publishes its parameters as an initial pose."""
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
        "Its orientation does not match the parameter yaw.",
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
