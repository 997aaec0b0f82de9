"""A missing and a differing baseline fail, and leave the picture and the difference: failures_test.py PROGRAM"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        work = folder / "work"
        baselines = folder / "baselines"
        work.mkdir()
        baselines.mkdir()

        def run(degree):
            done = subprocess.run(
                [sys.executable, HERE / "render_test.py", program, "made", "--scene", "basis", "--degree", degree],
                cwd=work, env={**os.environ, "SHOAL_BASELINES": os.fspath(baselines), "SHOAL_UPDATE_BASELINES": ""},
                capture_output=True, text=True)
            return done.returncode, done.stdout + done.stderr

        status, said = run("1")
        assert status == 1 and "there is no baseline" in said, said
        picture, difference = work / "made.png", work / "made.difference.png"
        assert picture.exists() and not difference.exists()
        shutil.copy(picture, baselines)
        status, said = run("1")
        assert status == 0 and "largest 0," in said, said
        status, said = run("2")
        assert status == 1 and "is not its baseline" in said, said
        assert picture.exists() and difference.exists()
        (baselines / "made.png").write_bytes(b"no picture")
        status, said = run("1")
        assert status == 1 and "cannot be read as PNG" in said, said


if __name__ == "__main__":
    main(sys.argv[1])
