"""`tf.transformations`: homogeneous matrices (4, 4), Euler angles and quaternions (x, y, z, w) as arrays.

Names, arguments and conventions are those of ROS's module
(http://docs.ros.org/en/jade/api/tf/html/python/transformations.html); the code follows textbook formulas.
Angles are in radians; a matrix is multiplied by a column vector on its right. Rarely used functions (shears,
projections, Arcball ...) are missing.
"""

from __future__ import annotations

from rosmini.core.geometry.products import inverse_matrix

from .euler import euler_from_matrix, euler_from_quaternion, euler_matrix, quaternion_from_euler
from .matrices import (
    concatenate_matrices,
    identity_matrix,
    is_same_transform,
    rotation_from_matrix,
    rotation_matrix,
    translation_from_matrix,
    translation_matrix,
    unit_vector,
    vector_norm,
)
from .parts import compose_matrix, decompose_matrix
from .quaternions import (
    quaternion_about_axis,
    quaternion_conjugate,
    quaternion_from_matrix,
    quaternion_inverse,
    quaternion_matrix,
    quaternion_multiply,
    quaternion_slerp,
    random_quaternion,
    random_rotation_matrix,
    random_vector,
)

__all__ = [
    "compose_matrix",
    "concatenate_matrices",
    "decompose_matrix",
    "euler_from_matrix",
    "euler_from_quaternion",
    "euler_matrix",
    "identity_matrix",
    "inverse_matrix",
    "is_same_transform",
    "quaternion_about_axis",
    "quaternion_conjugate",
    "quaternion_from_euler",
    "quaternion_from_matrix",
    "quaternion_inverse",
    "quaternion_matrix",
    "quaternion_multiply",
    "quaternion_slerp",
    "random_quaternion",
    "random_rotation_matrix",
    "random_vector",
    "rotation_from_matrix",
    "rotation_matrix",
    "translation_from_matrix",
    "translation_matrix",
    "unit_vector",
    "vector_norm",
]
