"""OpenImageIO, with the hundreds of libraries behind it, is loaded only where a file needs it."""

import support
from support import ShoalTest, plain_environment, write_exr, write_hdr, write_png


class Modules(ShoalTest):
    def loads(self, *arguments, status=0):
        """Whether the dynamic linker, asked to tell what it loads, tells of OpenImageIO."""
        done = self.expect(status, *arguments, env=plain_environment(LD_DEBUG="files"))
        self.assertIn("libc.so", done.err, "the dynamic linker tells nothing")
        return "libOpenImageIO" in done.err

    def setUp(self):
        super().setUp()
        write_hdr(self.folder / "lib/a.hdr", 1)
        write_exr(self.folder / "lib/b.exr", 2)
        self.write_manifest("maps: [{kind: irradiance, size: [16, 8], format: png}]\n")

    def test_not_for_what_shoal_reads_itself(self):
        self.assertFalse(self.loads("--version"))
        self.assertFalse(self.loads("targets"))
        self.assertFalse(self.loads("project", "lib/a.hdr", "lib/b.exr"))
        self.assertFalse(self.loads("check", "m.yaml"))
        self.assertFalse(self.loads("run", "m.yaml"))
        self.assertFalse(self.loads("verify", "--recompute", "out"))

    def test_for_a_png(self):
        write_png(self.folder / "c.png")
        done = self.shoal("project", "c.png")
        if done.status != 0 and "module" in done.err:
            self.skipTest("built without OpenImageIO: " + done.err)
        self.assertTrue(self.loads("project", "c.png"))
        self.assertTrue(self.loads("project", "lib/a.hdr", "c.png"))


if __name__ == "__main__":
    support.main()
