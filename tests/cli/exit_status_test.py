"""Exit statuses: 0 all well, 1 a panorama failed or a check found something, 2 usage, nothing run."""

import support
from support import ShoalTest, write_hdr


class GoodCalls(ShoalTest):
    def test_every_command(self):
        self.make_library()
        self.expect(0, "--version")
        self.expect(0, "--help")
        for command in ("run", "project", "check", "init", "verify", "targets"):
            self.assertIn("Usage", self.expect(0, command, "--help").out)
        self.expect(0, "targets")
        self.expect(0, "project", "lib/p00.hdr")
        self.expect(0, "check", "m.yaml")
        self.expect(0, "run", "m.yaml")
        self.expect(0, "verify", "out")
        self.expect(0, "init", "lib")


class Failures(ShoalTest):
    def test_a_panorama_that_fails(self):
        self.make_library()
        self.write("lib/bad.hdr", "no picture")
        self.expect(1, "project", "lib/bad.hdr")
        self.expect(1, "project", "missing.hdr")
        self.expect(1, "project", "lib")
        self.expect(1, "run", "m.yaml")
        self.expect(1, "verify", "out")
        self.expect(0, "check", "m.yaml")

    def test_verify_finds_a_changed_file(self):
        self.make_library()
        self.expect(0, "run", "m.yaml")
        self.write("out/coefficients.csv", "other")
        self.expect(1, "verify", "out")


class Usage(ShoalTest):
    def setUp(self):
        super().setUp()
        self.make_library()

    def usage_error(self, *arguments, says=()):
        done = self.expect(2, *arguments)
        self.assertEqual(done.out, "", arguments)
        self.assertNotEqual(done.err, "", arguments)
        for text in (says,) if isinstance(says, str) else says:
            self.assertIn(text, done.err, arguments)
        self.assertFalse((self.folder / "out").exists(), f"{arguments} wrote something")

    def test_no_or_unknown_command(self):
        self.usage_error()
        self.usage_error("rum", "m.yaml")

    def test_missing_arguments(self):
        for command in ("run", "project", "check", "init", "verify"):
            self.usage_error(command)

    def test_unknown_options(self):
        for command in ("run", "project", "check", "init", "verify", "targets"):
            self.usage_error(command, "--frobnicate", "m.yaml", says="--frobnicate")

    def test_values_out_of_range(self):
        for command, file in (("run", "m.yaml"), ("project", "lib/p00.hdr")):
            for option, value in (("--degree", "-1"), ("--degree", "65"), ("--degree", "two"), ("--degree", "2.5"),
                                  ("-j", "0"), ("-j", "many"), ("--threads", "-2")):
                self.usage_error(command, option, value, file, says=value)

    def test_unknown_names(self):
        for command, file in (("run", "m.yaml"), ("project", "lib/p00.hdr")):
            for option in ("--target", "--quadrature", "--quantity", "--frame", "--format"):
                self.usage_error(command, option, "teapot", file, says="teapot")
            self.usage_error(command, "--frame", "+x,+x,+y", file)
        self.usage_error("project", "--format", "npy", "lib/p00.hdr")
        self.usage_error("run", "--progress", "teapot", "m.yaml", says="teapot")

    def test_nearly_right_names_are_suggested(self):
        self.usage_error("run", "--quadrature", "texal", "m.yaml", says="texel")
        self.usage_error("run", "--frame", "openex", "m.yaml", says="openexr")
        self.usage_error("run", "--progress", "jsn", "m.yaml", says="json")
        self.usage_error("project", "--quantity", "irradianse", "lib/p00.hdr", says="irradiance")

    def test_manifests(self):
        for command in ("run", "check"):
            self.usage_error(command, "missing.yaml", says="missing.yaml")
            self.usage_error(command, "lib", says="lib")
            self.write("bad.yaml", "shoal: 1\noutput: out\npanorama: []\n")
            self.usage_error(command, "bad.yaml", says=("bad.yaml:3:1", "panoramas"))
            self.write("bad.yaml", "shoal: 1\noutput: out\npanoramas: [{file: gone.hdr}]\n")
            self.usage_error(command, "bad.yaml", says="gone.hdr")
            self.usage_error(command, "--set", "novalue", "m.yaml", says="novalue")
            self.usage_error(command, "--set", "=1", "m.yaml")
            self.usage_error(command, "--only", "nothing*", "m.yaml", says="nothing*")
            self.usage_error(command, "--only", "{a", "m.yaml")
        self.usage_error("run", "-n", "--only", "nothing*", "m.yaml")

    def test_an_npy_table_has_one_degree(self):
        write_hdr(self.folder / "other.hdr", 1)
        self.write("two.yaml", 'shoal: 1\noutput: out\npanoramas: [{files: "lib/*"}, {file: other.hdr, degree: 5}]\n')
        self.usage_error("run", "--format", "npy", "two.yaml", says="degree")
        self.expect(0, "run", "--format", "npy", "--degree", "3", "two.yaml")

    def test_verify_and_init_of_no_folder(self):
        self.usage_error("verify", "missing", says="missing")
        self.usage_error("verify", "lib", says="lib")
        self.usage_error("init", "missing", says="missing")

    def test_all_that_is_wrong_is_told_at_once(self):
        self.write("bad.yaml", "shoal: 1\noutput: out\npanoramas: [{file: gone.hdr, degre: 3}]\nmap: 1\n")
        done = self.expect(2, "check", "bad.yaml")
        for text in ("gone.hdr", "degre", "map", "3 errors"):
            self.assertIn(text, done.err)


if __name__ == "__main__":
    support.main()
