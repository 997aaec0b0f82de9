#!/usr/bin/env python3
"""Pictures drawn without a display are those drawn under X, byte for byte."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SCENES = ["basis", "lobes", "sphere", "degrees", "lit", "compare", "contact"]


def draw(tool, way, scene, path, environment, before=()):
    command = [*before, tool, "picture", way, scene, "640", "360", str(path)]
    result = subprocess.run(command, env=environment, capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(command)}: status {result.returncode}\n{result.stderr}")
    return path.read_bytes()


def main():
    tool = sys.argv[1]
    bare = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
    refused = subprocess.run([tool, "picture", "x_display", "basis", "64", "64", "no.png"], env=bare,
                             capture_output=True, text=True)
    assert refused.returncode == 1, f"without a display: status {refused.returncode}, not 1"
    assert refused.stderr == "there is no display: DISPLAY is not set\n", refused.stderr
    if not shutil.which("xvfb-run"):
        print("skipped: xvfb-run is not there")
        return 77
    xvfb = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24"]
    with tempfile.TemporaryDirectory() as folder:
        for scene in SCENES:
            one = draw(tool, "surfaceless", scene, pathlib.Path(folder) / "egl.png", bare)
            again = draw(tool, "surfaceless", scene, pathlib.Path(folder) / "egl2.png", bare)
            other = draw(tool, "x_display", scene, pathlib.Path(folder) / "x.png", bare, xvfb)
            assert one == again, f"{scene}: two runs differ"
            assert one == other, f"{scene}: the picture without a display is not the one under X"
            print(f"{scene}: {len(one)} bytes, the same both ways")
    return 0


if __name__ == "__main__":
    sys.exit(main())
