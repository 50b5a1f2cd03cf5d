"""Writes COLLADA 1.4.1 (https://www.khronos.org/files/collada_spec_1_4.pdf) that RViz, Gazebo and three.js load alike.

Metres, z up, triangles with normals, and one material for each surface.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .shapes import Shape

Floats = NDArray[np.float64]


def write(surfaces: Sequence[Shape]) -> str:
    """The surfaces as a COLLADA file. Coordinates are rounded to a tenth of a millimetre, normals to a thousandth."""
    names = [surface.name or f"surface{i}" for i, surface in enumerate(surfaces)]
    pairs = list(zip(names, surfaces, strict=True))
    effects = "".join(_effect(name, surface) for name, surface in pairs)
    materials = "".join(
        f'<material id="{name}-material"><instance_effect url="#{name}-effect"/></material>\n' for name in names
    )
    geometries = "".join(_geometry(name, surface) for name, surface in pairs)
    instances = "".join(
        f'<instance_geometry url="#{name}"><bind_material><technique_common>'
        f'<instance_material symbol="m" target="#{name}-material"/>'
        "</technique_common></bind_material></instance_geometry>\n"
        for name in names
    )
    return (
        '<?xml version="1.0" encoding="utf-8"?>\n'
        '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">\n'
        "<asset><contributor><authoring_tool>python -m assets.generate</authoring_tool></contributor>"
        "<created>2026-01-01T00:00:00</created><modified>2026-01-01T00:00:00</modified>"
        '<unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>\n'
        f"<library_effects>\n{effects}</library_effects>\n"
        f"<library_materials>\n{materials}</library_materials>\n"
        f"<library_geometries>\n{geometries}</library_geometries>\n"
        '<library_visual_scenes><visual_scene id="scene"><node id="mesh">\n'
        f"{instances}</node></visual_scene></library_visual_scenes>\n"
        '<scene><instance_visual_scene url="#scene"/></scene>\n</COLLADA>\n'
    )


def _effect(name: str, surface: Shape) -> str:
    colour = " ".join(_number(part, 3) for part in surface.colour or (0.6, 0.6, 0.6, 1.0))
    return (
        f'<effect id="{name}-effect"><profile_COMMON><technique sid="common"><phong>'
        f"<ambient><color>{colour}</color></ambient><diffuse><color>{colour}</color></diffuse>"
        "<specular><color>.15 .15 .15 1</color></specular><shininess><float>20</float></shininess>"
        "</phong></technique></profile_COMMON></effect>\n"
    )


def _geometry(name: str, surface: Shape) -> str:
    points, point_of = _distinct(surface.vertices, 4)
    normals, normal_of = _distinct(surface.normals, 3)
    corners = surface.faces.ravel()
    pairs = np.column_stack([point_of[corners], normal_of[corners]]).ravel().tolist()
    return (
        f'<geometry id="{name}"><mesh>\n{_source(f"{name}-p", points, 4)}{_source(f"{name}-n", normals, 3)}'
        f'<vertices id="{name}-v"><input semantic="POSITION" source="#{name}-p"/></vertices>\n'
        f'<triangles count="{len(surface.faces)}" material="m">'
        f'<input semantic="VERTEX" source="#{name}-v" offset="0"/>'
        f'<input semantic="NORMAL" source="#{name}-n" offset="1"/>'
        f"\n<p>{' '.join(map(str, pairs))}</p></triangles></mesh></geometry>\n"
    )


def _distinct(rows: Floats, digits: int) -> tuple[Floats, NDArray[np.int64]]:
    """The rows that differ after rounding, in the order of their first use, and which of them each row is."""
    # What is half way must not hang on the last bit of a cosine.
    whole = np.rint(rows * 10**digits + 1e-5).astype(np.int64)
    places: dict[tuple[int, ...], int] = {}
    which = [places.setdefault(tuple(row), len(places)) for row in whole.tolist()]
    return np.array(list(places), dtype=float) / 10**digits, np.array(which)


def _source(name: str, rows: Floats, digits: int) -> str:
    text = " ".join(_number(value, digits) for value in rows.ravel().tolist())
    accessor = "".join(f'<param name="{axis}" type="float"/>' for axis in "XYZ")
    return (
        f'<source id="{name}"><float_array id="{name}-a" count="{rows.size}">{text}</float_array><technique_common>'
        f'<accessor source="#{name}-a" count="{len(rows)}" stride="3">{accessor}</accessor>'
        "</technique_common></source>\n"
    )


def _number(value: float, digits: int) -> str:
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    text = text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) else text
    return "0" if text in {"", "-0", "-"} else text
