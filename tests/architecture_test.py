#!/usr/bin/env python3
"""Checks every include of engine/ and viz/ against the arrows of their houses, and who may include which
library.

    engine   app -> batch -> {transform, output, image};  transform -> {image, kernels, sphere}
             output -> sphere;  all -> core
    viz      app -> {report, scenes, window, library};  scenes -> {window, library};  report -> library
             all -> the engine's core, output and sphere, and nothing else of it; window -> core
"""
import pathlib
import re
import sys

# What a folder may include directly: its arrows, and what these reach without passing a door. `batch` and
# `app` speak the language of the mathematics (frames, quantities), so sphere is theirs as well; `app` forces
# SIMD targets and shrinks pictures through one header each.
MATHEMATICS = {"engine/core", "engine/output", "engine/sphere"}
ARROWS = {
    "engine/core": set(),
    "engine/sphere": {"engine/core"},
    "engine/kernels": {"engine/core"},
    "engine/image": {"engine/core"},
    "engine/output": {"engine/core", "engine/sphere"},
    "engine/transform": {"engine/core", "engine/image", "engine/kernels", "engine/sphere"},
    "engine/batch": {"engine/image", "engine/transform"} | MATHEMATICS,
    "engine/app": {"engine/batch"} | MATHEMATICS,
    "viz/library": MATHEMATICS,
    "viz/window": {"engine/core"},
    "viz/scenes": {"viz/library", "viz/window"} | MATHEMATICS,
    "viz/report": {"viz/library"} | MATHEMATICS,
    "viz/app": {"viz/library", "viz/report", "viz/scenes", "viz/window"} | MATHEMATICS,
}
ALLOWED_HEADERS = {("engine/app", "kernels/targets.h"), ("engine/app", "transform/preview.h")}

# Libraries with one door a house: pattern of the include, and the paths that may use it.
LIBRARIES = {
    r"hwy/": r"engine/kernels/",
    r"OpenImageIO/": r"engine/image/module/",
    r"(openexr|Imf|OpenEXR|Imath)": r"(engine/image|viz/library)/",
    r"libdeflate": r"(engine/image|viz/report)/",
    r"png\.h": r"(engine/image|viz/window)/",
    r"sqlite3": r"(engine/batch|viz/library)/",
    r"yaml-cpp/": r"engine/(batch|output)/",
    r"json/": r"viz/library/",
    r"CLI/": r"(engine|viz)/app/",
    r"(vtk|X11/)": r"viz/(window|scenes|app)/",
    r"(EGL|GL)/": r"viz/window/",
    r"xxhash": r"engine/core/",
}


def house_of(root, folder, header):
    """Where a quoted include of a folder is found: headers are named from the roots of the houses."""
    own = folder.split("/")[0]
    return next((house for house in (own, "engine") if (root / house / header).is_file()), None)


def problems(root, path):
    relative = path.relative_to(root)
    folder = "/".join(relative.parts[:2])
    for number, line in enumerate(path.read_text().splitlines(), 1):
        own = re.match(r'#include "([^"]+)"', line)
        foreign = re.match(r"#include <([^>]+)>", line)
        where = f"{relative}:{number}"
        if own:
            header = own.group(1)
            house = house_of(root, folder, header)
            target = f"{house}/{header.split('/')[0]}"
            if house is None:
                yield f'{where}: "{header}" is not a path below engine/ or viz/'
            elif target != folder and target not in ARROWS[folder]:
                if (folder, header) not in ALLOWED_HEADERS:
                    yield f"{where}: {folder} may not include {target}"
        elif foreign:
            for library, door in LIBRARIES.items():
                if re.match(library, foreign.group(1)) and not re.match(door, str(relative)):
                    yield f"{where}: <{foreign.group(1)}> has another door than {folder}"


def main():
    root = pathlib.Path(sys.argv[1])
    sources = [path for house in ("engine", "viz") for path in sorted((root / house).rglob("*"))
               if path.suffix in {".h", ".cpp"}]
    folders = {f"{house}/{path.name}" for house in ("engine", "viz") for path in (root / house).iterdir()
               if path.is_dir()}
    found = [] if folders == set(ARROWS) else [
        f"folders {sorted(folders ^ set(ARROWS))} differ from the table"]
    for path in sources:
        found += problems(root, path)
    print("\n".join(found) or "every include follows the arrows")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
