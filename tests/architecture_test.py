#!/usr/bin/env python3
"""Checks every include of engine/ against the arrows of the house, and who may include which library.

    app -> batch -> {transform, output, image};  transform -> {image, kernels, sphere}
    output -> sphere;  all -> core
"""
import pathlib
import re
import sys

# What a folder may include directly: its arrows, and what these reach without passing a door. `batch` and
# `app` speak the language of the mathematics (frames, quantities), so sphere is theirs as well; `app` forces
# SIMD targets through kernels/targets.h alone.
ARROWS = {
    "core": set(),
    "sphere": {"core"},
    "kernels": {"core"},
    "image": {"core"},
    "output": {"core", "sphere"},
    "transform": {"core", "image", "kernels", "sphere"},
    "batch": {"core", "image", "output", "sphere", "transform"},
    "app": {"batch", "core", "output", "sphere"},
}
ALLOWED_HEADERS = {("app", "kernels/targets.h")}

# Libraries with one door: pattern of the include, and the paths (below engine/) that may use it.
LIBRARIES = {
    r"hwy/": r"kernels/",
    r"OpenImageIO/": r"image/module/",
    r"(openexr|Imf|OpenEXR|Imath)": r"image/",
    r"libdeflate": r"image/",
    r"png\.h": r"image/",
    r"sqlite3": r"batch/",
    r"yaml-cpp/": r"batch/",
    r"CLI/": r"app/",
    r"vtk": r"(?!)",
    r"xxhash": r"core/",
}


def problems(engine):
    for path in sorted(engine.rglob("*")):
        if path.suffix not in {".h", ".cpp"}:
            continue
        relative = path.relative_to(engine)
        folder = relative.parts[0]
        for number, line in enumerate(path.read_text().splitlines(), 1):
            own = re.match(r'#include "([^"]+)"', line)
            foreign = re.match(r"#include <([^>]+)>", line)
            where = f"{relative}:{number}"
            if own:
                header = own.group(1)
                target = header.split("/")[0]
                if not (engine / header).is_file():
                    yield f"{where}: \"{header}\" is not a path below engine/"
                elif target != folder and target not in ARROWS[folder]:
                    if (folder, header) not in ALLOWED_HEADERS:
                        yield f"{where}: {folder} may not include {target}"
            elif foreign:
                for library, door in LIBRARIES.items():
                    if re.match(library, foreign.group(1)) and not re.match(door, str(relative)):
                        yield f"{where}: <{foreign.group(1)}> has another door than {folder}"


def main():
    engine = pathlib.Path(sys.argv[1])
    folders = {p.name for p in engine.iterdir() if p.is_dir()}
    found = list(problems(engine))
    if folders != set(ARROWS):
        found.append(f"folders {sorted(folders ^ set(ARROWS))} differ from the table")
    print("\n".join(found) or "every include follows the arrows")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
