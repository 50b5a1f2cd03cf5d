"""Calls functions of ``tf.transformations`` and writes what they return as JSON: run by real ROS and by ours."""

import json
import sys

import numpy as np


def plain(value):
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, (tuple, list)):
        return [plain(part) for part in value]
    if isinstance(value, (np.floating, np.bool_)):
        return value.item()
    return value


AXES = [
    frame + first + second + third
    for frame in "sr"
    for first in "xyz"
    for second in "xyz"
    for third in "xyz"
    if second not in (first, third)
]


def answers(t):
    """Every answer by what was asked. Inputs are drawn in one order from one seed."""
    r = np.random.RandomState(31)
    found = {}

    def ask(name, *args, **options):
        function = getattr(t, name)
        key = f"{name} {sum(1 for other in found if other.split()[0] == name)}"
        try:
            found[key] = plain(function(*args, **options))
        except (ValueError, KeyError) as error:
            found[key] = type(error).__name__

    for axes in AXES:
        for angles in [*r.uniform(-3.1, 3.1, (4, 3)), (0.3, 0.0, 0.4), (0.0, 0.0, 0.0)]:
            matrix = t.euler_matrix(*angles, axes=axes)
            ask("euler_matrix", *angles, axes=axes)
            ask("euler_from_matrix", matrix, axes)
            quaternion = t.quaternion_from_euler(*angles, axes=axes)
            ask("quaternion_from_euler", *angles, axes=axes)
            ask("euler_from_quaternion", quaternion, axes)
    for _ in range(40):
        a, b = r.normal(size=4), r.normal(size=4)
        v, w, u = r.normal(size=3), r.normal(size=3), r.normal(size=3)
        s, angle = r.uniform(), r.uniform(-3, 3)
        ask("quaternion_multiply", a, b)
        ask("quaternion_matrix", a)
        ask("quaternion_inverse", a)
        ask("quaternion_conjugate", a)
        ask("quaternion_from_matrix", t.quaternion_matrix(a))
        for spin in (0, 1, -2):
            for shortest in (True, False):
                ask("quaternion_slerp", a, b, s, spin, shortest)
        ask("quaternion_about_axis", angle, v)
        ask("random_quaternion", r.uniform(size=3))
        ask("random_rotation_matrix", r.uniform(size=3))
        ask("rotation_matrix", angle, v)
        ask("rotation_matrix", angle, v, w)
        ask("translation_matrix", v)
        ask("translation_from_matrix", t.translation_matrix(v))
        parts = (1 + abs(v)), w, (v * 0.5), u, (0.1, 0.2, -0.1, 1)
        ask("compose_matrix", *parts)
        ask("decompose_matrix", t.compose_matrix(*parts))
        ask("unit_vector", v)
        ask("unit_vector", [v, w], 1)
        ask("vector_norm", v)
        ask("vector_norm", [v, w], 0)
        ask("concatenate_matrices", t.quaternion_matrix(a), t.translation_matrix(v), t.quaternion_matrix(b))
        ask("inverse_matrix", t.quaternion_matrix(a))
        ask("is_same_transform", t.quaternion_matrix(a), 2 * t.quaternion_matrix(a))
        ask("is_same_transform", t.quaternion_matrix(a), t.quaternion_matrix(b))
    for turn in (np.diag([1, -1, -1, 1.0]), np.diag([-1, 1, -1, 1.0]), np.diag([-1, -1, 1, 1.0]), 2 * np.eye(4)):
        ask("quaternion_from_matrix", turn)
        ask("euler_from_matrix", turn)
    ask("euler_from_matrix", t.euler_matrix(0.3, np.pi / 2, 0.2))
    ask("euler_from_matrix", t.euler_matrix(0.3, 0, 0.2, "szxz"), "szxz")
    ask("quaternion_matrix", [0, 0, 0, 0])
    ask("identity_matrix")
    ask("euler_matrix", 1, 2, 3, "foo")
    ask("euler_matrix", 1, 2, 3, (1, 1, 0, 1))
    ask("euler_matrix", 1, 2, 3, (2, 0, 1, 0))
    ask("rotation_from_matrix", np.diag([2, 3, 4, 1.0]))
    ask("decompose_matrix", np.zeros((4, 4)))
    return found


if __name__ == "__main__":
    import tf.transformations

    json.dump(answers(tf.transformations), sys.stdout)
