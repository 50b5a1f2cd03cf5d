"""`python -m assets.generate`: make the committed worlds, maps, .rviz files, meshes and pictures again."""

from __future__ import annotations

from pathlib import Path

from . import rviz_files, worlds
from .drawings import CHAPTERS, PAGES
from .meshes import turtlebot3

CHECKOUT = Path(__file__).resolve().parents[2]


def texts() -> dict[str, str]:
    """Every file that is compared byte by byte, by its path in a checkout."""
    made = {f"assets/ros/{path}": text for path, text in worlds.sdf_texts().items()}
    made |= {f"assets/ros/{path}": text for path, text in rviz_files.texts().items()}
    for name, text in turtlebot3.files().items():
        made[f"assets/ros/turtlebot3_description/meshes/{name}"] = text
    for folder, drawings in (("book/static", PAGES), ("rosmini/book", CHAPTERS)):
        made |= {f"{folder}/drawings/{name}.svg": drawing + "\n" for name, drawing in drawings.items()}
    return made


def main(checkout: Path = CHECKOUT) -> None:
    """Write all files into `checkout` and print which."""
    for path, text in texts().items():
        file = checkout / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8", newline="\n")
        print(file)
    for file in worlds.write_maps(checkout / "assets/ros"):
        print(file)


if __name__ == "__main__":
    main()
