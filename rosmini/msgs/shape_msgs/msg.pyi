# Written by python -m assets.generate; do not edit.
from typing import Any, ClassVar, Sequence, overload
from rosmini.msgs.geometry_msgs import msg as _geometry_msgs
from rosmini.msgs.message import Message as _Message

class Mesh(_Message):
    triangles: list[MeshTriangle]
    vertices: list[_geometry_msgs.Point]
    @overload
    def __init__(self, *, triangles: Sequence[MeshTriangle] | None = ..., vertices: Sequence[_geometry_msgs.Point] | None = ...) -> None: ...
    @overload
    def __init__(self, triangles: Sequence[MeshTriangle] | None, vertices: Sequence[_geometry_msgs.Point] | None, /) -> None: ...

class MeshTriangle(_Message):
    vertex_indices: Any
    @overload
    def __init__(self, *, vertex_indices: Sequence[int] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, vertex_indices: Sequence[int] | Any | None, /) -> None: ...

class Plane(_Message):
    coef: Any
    @overload
    def __init__(self, *, coef: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, coef: Sequence[float] | Any | None, /) -> None: ...

class SolidPrimitive(_Message):
    BOX: ClassVar[int]
    SPHERE: ClassVar[int]
    CYLINDER: ClassVar[int]
    CONE: ClassVar[int]
    BOX_X: ClassVar[int]
    BOX_Y: ClassVar[int]
    BOX_Z: ClassVar[int]
    SPHERE_RADIUS: ClassVar[int]
    CYLINDER_HEIGHT: ClassVar[int]
    CYLINDER_RADIUS: ClassVar[int]
    CONE_HEIGHT: ClassVar[int]
    CONE_RADIUS: ClassVar[int]
    type: int
    dimensions: Any
    @overload
    def __init__(self, *, type: int | None = ..., dimensions: Sequence[float] | Any | None = ...) -> None: ...
    @overload
    def __init__(self, type: int | None, dimensions: Sequence[float] | Any | None, /) -> None: ...
