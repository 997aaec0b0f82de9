"""Renders NAME.png here and compares it with its baseline: render_test.py PROGRAM NAME ARGUMENTS...

With SHOAL_UPDATE_BASELINES set, the picture becomes the baseline instead.
"""

import os
import pathlib
import shutil
import subprocess
import sys

SIZE = "640x360"
MOST_SHARE = "0.002"
MOST_BYTES = 120_000


def call(*words):
    done = subprocess.run([os.fspath(word) for word in words], capture_output=True, text=True,
                          env={**os.environ, "DISPLAY": ""})
    sys.stdout.write(done.stdout + done.stderr)
    return done.returncode


def main(program, name, *arguments):
    baselines = pathlib.Path(os.environ.get("SHOAL_BASELINES", pathlib.Path(__file__).parent / "baselines"))
    baseline, picture = baselines / f"{name}.png", pathlib.Path(f"{name}.png").resolve()
    difference = picture.with_suffix(".difference.png")
    picture.unlink(missing_ok=True)
    difference.unlink(missing_ok=True)
    if call(program, "render", *arguments, "--size", SIZE, "-o", picture) != 0:
        return "the program cannot render it"
    if picture.stat().st_size > MOST_BYTES:
        return f"{picture} has {picture.stat().st_size} bytes; a baseline has {MOST_BYTES} at most"
    if os.environ.get("SHOAL_UPDATE_BASELINES"):
        shutil.copy(picture, baseline)
        return ""
    if not baseline.exists():
        return f"there is no baseline {baseline}; the picture is {picture}"
    if call(program, "compare", baseline, picture, "--share", MOST_SHARE, "--difference", difference) != 0:
        return f"{picture} is not its baseline; the difference is {difference}"
    return ""


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) or 0)
