"""Output folders in which nothing can be written."""

import os
import pwd
import stat

import support
from support import ShoalTest, write_hdr


class Refused(ShoalTest):
    def refused(self, says, **more):
        """The run ends before it begins, says why, and leaves nothing behind."""
        done = self.expect(2, "run", "m.yaml", **more)
        self.assertEqual(len([line for line in done.err.splitlines() if line.startswith("error: ")]), 1, done)
        self.assertIn(says, done.err)

    def test_the_output_is_a_file(self):
        self.make_library(1)
        self.write("out", "mine")
        self.refused("out")
        self.assertEqual((self.folder / "out").read_text(), "mine")

    def test_the_output_is_below_a_file(self):
        self.make_library(1)
        self.write("file", "mine")
        self.write("m.yaml", 'shoal: 1\noutput: file/out\npanoramas: [{files: "lib/*"}]\n')
        self.refused("file")

    def test_the_store_is_no_store(self):
        self.make_library(1)
        self.write("out/shoal.db", "some text that somebody else wrote here, long enough for a header" * 4)
        self.refused("shoal.db")
        self.assertTrue((self.folder / "out/shoal.db").read_text().startswith("some text"))

    def test_maps_is_a_file(self):
        """The panoramas fail, each with its line; the tables are written all the same."""
        self.make_library(2)
        self.write_manifest("maps: [{kind: irradiance, size: [8, 4]}]\n")
        self.write("out/maps", "mine")
        done = self.expect(1, "run", "m.yaml")
        self.assertEqual(done.err.count("failed: "), 2)
        os.unlink(self.folder / "out/maps")
        self.assertIn("2 panoramas done", self.expect(0, "run", "m.yaml").err)

    def as_somebody(self):
        """Arguments with which the program runs as somebody whom permissions bind."""
        if os.geteuid() != 0:
            return {}
        nobody = pwd.getpwnam("nobody").pw_uid
        os.chmod(self.folder, 0o755)
        try:
            support.shoal("--version", user=nobody)
        except PermissionError:
            self.skipTest("the program cannot be run by anybody but root")
        return {"user": nobody}

    def test_a_folder_that_is_read_only(self):
        self.make_library(1)
        somebody = self.as_somebody()
        (self.folder / "out").mkdir()
        os.chmod(self.folder / "out", stat.S_IRUSR | stat.S_IXUSR | stat.S_IROTH | stat.S_IXOTH)
        self.refused("out", **somebody)
        self.assertEqual(os.listdir(self.folder / "out"), [])

    def test_checking_and_verifying_what_is_read_only(self):
        self.make_library(2)
        somebody = self.as_somebody()
        self.expect(0, "run", "m.yaml")
        for path in [self.folder / "out", *(self.folder / "out").rglob("*")]:
            os.chmod(path, 0o555 if path.is_dir() else 0o444)
        self.assertIn("2 up to date", self.expect(0, "check", "m.yaml", **somebody).out)
        self.expect(0, "verify", "--recompute", "out", **somebody)

    def test_an_input_that_may_not_be_read(self):
        self.make_library(2)
        write_hdr(self.folder / "lib/secret.hdr", 5)
        somebody = self.as_somebody()
        if somebody:
            (self.folder / "out").mkdir()
            os.chown(self.folder / "out", somebody["user"], -1)
        os.chmod(self.folder / "lib/secret.hdr", 0)
        done = self.expect(1, "run", "m.yaml", **somebody)
        self.assertIn("secret.hdr", done.err)
        self.assertIn("2 panoramas done, 1 failed", done.err)


if __name__ == "__main__":
    support.main()
