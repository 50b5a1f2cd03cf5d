"""`tests/` mirrors `rosmini/`: whoever looks for the tests of a folder finds them in the folder of the same name."""

from __future__ import annotations

from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
# What tests more than one folder of the library, or none.
ACROSS = {"assets", "benchmarks", "browser", "data", "gates", "interop", "jupyter", "report"}


def modules_of_tests() -> list[Path]:
    found = sorted((ROOT / "tests").rglob("test_*.py"))
    return [path for path in found if path.relative_to(ROOT / "tests").parts[0] not in ACROSS]


def test_each_folder_of_tests_has_its_folder_in_the_library():
    folders = {path.parent.relative_to(ROOT / "tests") for path in modules_of_tests()}
    assert [str(folder) for folder in sorted(folders) if not (ROOT / "rosmini" / folder).is_dir()] == []


@pytest.mark.parametrize("path", modules_of_tests(), ids=lambda path: str(path.relative_to(ROOT / "tests")))
def test_a_test_of_a_module_lies_at_its_depth(path):
    """`tests/sim/test_rasters.py` would be refused while the module is `rosmini/sim/worlds/rasters.py`."""
    name, folder = path.stem.removeprefix("test_"), ROOT / "rosmini" / path.parent.relative_to(ROOT / "tests")
    if (folder / f"{name}.py").is_file():
        return
    deeper = [
        *folder.glob(f"*/**/{name}.py"),
        *(found for found in folder.glob(f"**/{name}") if found.is_dir()),
    ]
    at_the_top = path.parent == ROOT / "tests"
    assert at_the_top or deeper == [], f"{path.name} tests {deeper[0].relative_to(ROOT)}: move it there"
