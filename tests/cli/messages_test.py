"""Data to standard output, messages to standard error, colours to nobody who cannot show them."""

import json
import time

import support
from support import ESCAPE, STYLE, ShoalTest, start, write_constant_hdr


class Streams(ShoalTest):
    def test_version_and_targets_are_data(self):
        done = self.expect(0, "--version")
        self.assertRegex(done.out, r"^shoal \d+\.\d+\.\d+\n$")
        self.assertEqual(done.err, "")
        done = self.expect(0, "targets")
        self.assertEqual(done.err, "")
        self.assertEqual(done.out.count("(active)"), 1)

    def test_every_target_can_be_forced_and_gives_the_same_bytes(self):
        self.make_library(1)
        names = [line.split()[0] for line in self.expect(0, "targets").out.splitlines()]
        tables = {self.expect(0, "project", "--target", name, "lib/p00.hdr").out for name in names}
        self.assertEqual(len(tables), 1)

    def test_a_run_prints_no_data(self):
        self.make_library()
        self.write("lib/bad.hdr", "no picture")
        done = self.expect(1, "run", "m.yaml")
        self.assertEqual(done.out, "")
        failed = [line for line in done.err.splitlines() if line.startswith("failed: ")]
        self.assertEqual(len(failed), 1, done)
        self.assertIn("lib/bad.hdr", failed[0])
        for text in ("3 panoramas done", "1 failed", "out/coefficients.csv", "out/shoal.db"):
            self.assertIn(text, done.err)

    def test_project_says_what_is_odd_on_stderr_only(self):
        write_constant_hdr(self.folder / "odd.hdr", (128, 128, 128), 129)
        text = (self.folder / "odd.hdr").read_bytes().replace(b"FORMAT=", b"EXPOSURE=0\nFORMAT=")
        (self.folder / "odd.hdr").write_bytes(text)
        done = self.expect(0, "project", "odd.hdr")
        self.assertRegex(done.err, r"^warning: odd\.hdr: .*EXPOSURE")
        self.assertEqual(len(done.out.splitlines()), 10)

    def test_a_plan_is_data(self):
        self.make_library()
        for arguments in (("check", "m.yaml"), ("run", "-n", "m.yaml")):
            done = self.expect(0, *arguments)
            self.assertEqual(done.err, "")
            self.assertEqual(done.out.count("(new)"), 3)
            self.assertIn("3 to project", done.out)

    def test_full_disk(self):
        self.make_library(1)
        for arguments in (("project", "lib/p00.hdr"), ("project", "--degree", "64", "lib/p00.hdr"),
                          ("project", "--format", "json", "lib/p00.hdr"), ("check", "m.yaml"), ("targets",)):
            with open("/dev/full", "wb") as full:
                process = start(*arguments, cwd=self.folder, stdout=full, stderr=support.subprocess.PIPE)
                err = process.communicate(timeout=60)[1].decode()
            self.assertEqual(process.returncode, 1, (arguments, err))
            self.assertIn("standard output", err)


class Colours(ShoalTest):
    def test_none_in_pipes(self):
        self.make_library()
        self.write("lib/bad.hdr", "no picture")
        self.write("bad.yaml", "shoal: 1\nfoo: 1\n")
        for arguments in (("run", "m.yaml"), ("check", "m.yaml"), ("check", "bad.yaml"), ("verify", "out"),
                          ("project", "lib/bad.hdr"), ("run", "--quadrature", "x", "m.yaml")):
            done = self.shoal(*arguments)
            self.assertNotIn(ESCAPE, done.out + done.err)

    def on_terminal(self, **environment):
        """What a run with a failure says on a terminal."""
        done = self.shoal_on_terminal("run", "m.yaml", **environment)
        self.assertEqual(done.status, 1)
        return done.out

    def test_on_a_terminal_unless_no_color(self):
        self.make_library()
        self.write("lib/bad.hdr", "no picture")
        self.assertRegex(self.on_terminal(), STYLE)
        self.assertNotRegex(self.on_terminal(NO_COLOR="1"), STYLE)
        self.assertNotRegex(self.on_terminal(TERM="dumb"), STYLE)


class Progress(ShoalTest):
    def test_json_is_all_that_is_said(self):
        self.make_library(5)
        self.write("lib/bad.hdr", "no picture")
        odd = self.folder / "lib/p00.hdr"
        odd.write_bytes(odd.read_bytes().replace(b"FORMAT=", b"EXPOSURE=0\nFORMAT="))
        events = [json.loads(line) for line in
                  self.expect(1, "run", "--progress", "json", "m.yaml").err.splitlines()]
        self.assertEqual(events[0]["event"], "start")
        self.assertEqual(events[0]["panoramas"], 6)
        self.assertEqual(events[-1]["event"], "end")
        self.assertEqual((events[-1]["done"], events[-1]["failed"]), (5, 1))
        told = {event["name"]: event for event in events if event["event"] == "panorama"}
        self.assertEqual(sorted(told), ["bad", "p00", "p01", "p02", "p03", "p04"])
        self.assertEqual(told["bad"]["status"], "failed")
        self.assertIn("lib/bad.hdr", told["bad"]["error"])
        self.assertIn("EXPOSURE", told["p00"]["warnings"][0])
        self.assertNotIn("warnings", told["p01"])
        self.assertEqual(told["p02"]["pixels"], 32 * 16)
        times = [event["elapsed"] for event in events]
        self.assertEqual(times, sorted(times))

    def test_an_error_of_the_manifest_is_told_to_people(self):
        self.assertIn("missing.yaml", self.expect(2, "run", "--progress", "json", "missing.yaml").err)

    def test_none_and_plain_of_a_short_run_show_no_progress(self):
        self.make_library()
        said = {mode: self.expect(0, "run", "--force", "--progress", mode, "m.yaml").err
                for mode in ("none", "plain", "auto")}
        for text in said.values():
            self.assertIn("3 panoramas done", text)
            self.assertNotIn("ETA", text)


class Speed(ShoalTest):
    def test_version_is_immediate(self):
        """The best of many, for the machine has other things to do."""
        def seconds():
            begin = time.perf_counter()
            self.expect(0, "--version")
            return time.perf_counter() - begin
        self.assertLess(min(seconds() for _ in range(20)), 0.05)


if __name__ == "__main__":
    support.main()
