"""What a .cfg file becomes, in short: http://wiki.ros.org/dynamic_reconfigure/Tutorials/HowToWriteYourFirstCfgFile."""

from dynamic_reconfigure.encoding import extract_params

inf = float("inf")
config_description = {
    "name": "Default",
    "type": "",
    "state": True,
    "id": 0,
    "parent": 0,
    "parameters": [
        {
            "name": "speed",
            "type": "double",
            "default": 1.0,
            "level": 1,
            "description": "how fast",
            "min": 0.0,
            "max": 2.0,
            "edit_method": "",
        },
        {
            "name": "lights",
            "type": "bool",
            "default": True,
            "level": 2,
            "description": "whether it shines",
            "min": False,
            "max": True,
            "edit_method": "",
        },
    ],
    "groups": [],
}
min = {}
max = {}
defaults = {}
for param in extract_params(config_description):
    min[param["name"]] = param["min"]
    max[param["name"]] = param["max"]
    defaults[param["name"]] = param["default"]
