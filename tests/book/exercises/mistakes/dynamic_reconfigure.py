"""Wrong answers to the exercises of the chapter dynamic_reconfigure: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .nodes_and_master import wrong
from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

CAMERA = """\
#!/usr/bin/env python3
from dynamic_reconfigure.parameter_generator_catkin import *

gen = ParameterGenerator()
gen.add("rate", double_t, 1, "images per second", 10.0, 1.0, 30.0)
gen.add("exposure", int_t, 2, "exposure time [ms]", 100, 1, 1000)
gen.add("flip", bool_t, 2, "turn images upside down", False)
exit(gen.generate("watcher", "camera", "Camera"))
"""

CAREFUL = solution("dynamic_reconfigure", "careful_client")

LIGHTS = solution("dynamic_reconfigure", "lights")


def _camera(old: str, new: str) -> Callable[[], str]:
    assert old in CAMERA
    return lambda: CAMERA.replace(old, new)


MISTAKES = {
    "camera_cfg": [
        _camera("double_t", "int_t"),
        _camera('int_t, 2, "exposure', 'int_t, 1, "exposure'),
        _camera("10.0, 1.0", "12.0, 1.0"),
        _camera("1, 1000", "0, 1000"),
        _camera('"Camera"', '"Cameras"'),
        _camera('"watcher", "camera"', '"camera", "watcher"'),
        _camera("#!/usr/bin/env python3\n", ""),
        _camera('gen.add("flip", bool_t, 2, "turn images upside down", False)\n', ""),
        _camera("exit(", 'gen.add("zoom", int_t, 4, "zoom", 1, 1, 9)\nexit('),
        _camera("ParameterGenerator()", "ParameterGenerator("),
        lambda: 42,
    ],
    "careful_client": [
        wrong("careful.py", CAREFUL, "    if wanted != speed:\n", "    if True:\n"),
        wrong("careful.py", CAREFUL, "< 1.5", "< 0.5"),
        wrong("careful.py", CAREFUL, "0.05 if", "0.2 if"),
        wrong("careful.py", CAREFUL, '{"speed": wanted}', '{"sped": wanted}'),
        wrong("careful.py", CAREFUL, 'client.update_configuration({"speed": wanted})', "pass"),
        wrong("careful.py", CAREFUL, "ranges[0]", "ranges[180]"),
    ],
    "lights": [
        wrong("lights.py", LIGHTS, "> 0.15", "< 0.15"),
        wrong("lights.py", LIGHTS, " and wanted != lights"),
        wrong("lights.py", LIGHTS, ", config_callback=on_config"),
        wrong("lights.py", LIGHTS, '{"lights": wanted}', '{"lights": wanted, "speed": 0.2}'),
        wrong("lights.py", LIGHTS, "> 0.15", "> 0.0"),
    ],
}
