"""OpenImageIO, with the hundreds of libraries behind it, and OpenEXR's C++ classes are loaded only where they are
needed."""

import re

import support
from support import ShoalTest, plain_environment, write_exr, write_hdr, write_png


class Modules(ShoalTest):
    def linker(self, topic, *arguments):
        """What the dynamic linker tells of a topic when it is asked to."""
        done = self.expect(0, *arguments, env=plain_environment(LD_DEBUG=topic))
        self.assertIn("libc.so", done.err, "the dynamic linker tells nothing")
        return done.err

    def loads(self, *arguments, library="libOpenImageIO"):
        return library in self.linker("files", *arguments)

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

    def test_openexr_classes_for_an_exr_map(self):
        classes = "libOpenEXR-"  # and not libOpenEXRCore-
        for arguments in (["--version"], ["project", "lib/a.hdr", "lib/b.exr"], ["check", "m.yaml"], ["run", "m.yaml"]):
            self.assertFalse(self.loads(*arguments, library=classes), arguments)
        self.write_manifest("maps: [{kind: irradiance, size: [16, 8], format: exr}]\n")
        self.assertTrue(self.loads("run", "m.yaml", library=classes))

    def test_no_module_takes_a_cplusplus_symbol_of_the_program(self):
        """Where libstdc++ is inside the program, modules bring another: neither may see the other's symbols."""
        if self.loads("--version", library="libstdc++"):
            self.skipTest("the program shares its libstdc++ with the modules")
        self.write_manifest("maps: [{kind: irradiance, size: [16, 8], format: exr}]\n")
        told = self.linker("bindings", "run", "m.yaml")
        self.assertRegex(told, r"binding file \S*shoal_exr\.so .* to \S*libstdc\+\+\S* .* symbol `_Z", "nothing was bound")
        crossed = re.findall(r"binding file (\S+\.so\S*) .* to (\S*/shoal) \[0\]: \w+ symbol `(_Z\w+)'", told)
        self.assertEqual(crossed, [])


if __name__ == "__main__":
    support.main()
