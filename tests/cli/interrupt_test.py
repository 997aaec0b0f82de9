"""Ctrl-C: exit status 130, finished work is kept, nothing is left half-written."""

import json
import signal
import subprocess
import time

import support
from support import ShoalTest, is_temporary, start, write_hdr


class Interrupt(ShoalTest):
    def interrupted_run(self, number):
        """Interrupts a run after its third panorama; returns how many it says were done."""
        process = start("run", "-j", "2", "--progress", "json", "m.yaml", cwd=self.folder,
                        stderr=subprocess.PIPE, text=True)
        events = []
        for line in process.stderr:
            events.append(json.loads(line))
            if len(events) == 4:
                process.send_signal(number)
        process.stderr.close()
        self.assertEqual(process.wait(60), 130)
        self.assertEqual(events[-1]["event"], "end")
        return events[-1]["done"]

    def test_run(self):
        self.make_library(60)
        self.write_manifest("maps: [{kind: irradiance, size: [512, 256], format: exr}]\n")
        for number in (signal.SIGINT, signal.SIGTERM):
            done = self.interrupted_run(number)
            self.assertGreaterEqual(done, 3)
            self.assertLess(done, 60)
            self.assertFalse((self.folder / "out/coefficients.csv").exists())
            self.assertEqual([name for name in self.outputs() if is_temporary(name)], [])
            plan = self.expect(0, "check", "m.yaml").out
            self.assertIn(f"{done} up to date", plan)
            support.shutil.rmtree(self.folder / "out")
        done = self.interrupted_run(signal.SIGINT)
        self.assertIn(f"{60 - done} panoramas done, {done} up to date", self.expect(0, "run", "m.yaml").err)
        resumed = self.outputs()
        support.shutil.rmtree(self.folder / "out")
        self.expect(0, "run", "m.yaml")
        self.assertEqual(self.outputs(), resumed)

    def test_people_are_told(self):
        self.make_library(60)
        self.write_manifest("maps: [{kind: irradiance, size: [512, 256], format: exr}]\n")
        process = start("run", "-j", "1", "m.yaml", cwd=self.folder, stderr=subprocess.PIPE, text=True)
        while not list(self.folder.glob("out/maps/*.exr")):
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        err = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("interrupted; what is finished is kept", err)

    def test_project(self):
        """The slow twin, so that there is time to interrupt; what is printed are whole panoramas."""
        write_hdr(self.folder / "a.hdr", 1, 128, 64)
        process = start("project", "-j", "1", "--reference", "--degree", "16", *["a.hdr"] * 200,
                        cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertEqual(err, b"")
        lines = out.splitlines()
        self.assertEqual(lines[0], b"panorama,quantity,l,m,r,g,b")
        self.assertEqual((len(lines) - 1) % 17**2, 0)
        self.assertLess(len(lines), 200 * 17**2)


if __name__ == "__main__":
    support.main()
