"""The life of an output folder: runs that do all, nothing, or a part; and what they say."""

import csv
import io
import json
import os
import shutil
import struct

import support
from support import ShoalTest, files_below, write_hdr

MAPS = ("maps:\n  - {kind: irradiance, size: [16, 8], format: exr}\n"
        "  - {kind: radiance, layout: cube, size: 4, format: hdr}\n")


class Life(ShoalTest):
    def setUp(self):
        super().setUp()
        self.make_library(4)
        self.write_manifest("tables: [csv, json, npy]\n" + MAPS)

    def stamps(self):
        return {path: path.stat().st_mtime_ns for path in (self.folder / "out").rglob("*")
                if path.is_file() and not path.name.startswith(support.STORE)}

    def test_first_run_writes_all(self):
        done = self.expect(0, "run", "m.yaml")
        self.assertIn("4 panoramas done", done.err)
        self.assertEqual(sorted(self.outputs()), sorted(
            ["coefficients.csv", "coefficients.json", "coefficients.npy", "coefficients.names.csv"]
            + [f"maps/p{i:02}.{kind}" for i in range(4) for kind in ("irradiance.exr", "radiance.cube.hdr")]))
        self.assertTrue((self.folder / "out/shoal.db").is_file())

    def test_second_run_does_nothing(self):
        self.expect(0, "run", "m.yaml")
        before, stamps = self.outputs(), self.stamps()
        done = self.expect(0, "run", "m.yaml")
        self.assertIn("0 panoramas done, 4 up to date", done.err)
        self.assertEqual(self.outputs(), before)
        self.assertEqual(self.stamps(), stamps, "files were written again")

    def test_force_writes_the_same_bytes(self):
        self.expect(0, "run", "m.yaml")
        before = self.outputs()
        done = self.expect(0, "run", "--force", "m.yaml")
        self.assertIn("4 panoramas done", done.err)
        self.assertEqual(self.outputs(), before)

    def test_the_same_bytes_elsewhere_and_with_other_threads(self):
        """Nothing of folder, time or scheduling is in what is written."""
        self.expect(0, "run", "-j", "1", "m.yaml")
        before = self.outputs()
        other = self.folder / "else where"
        shutil.copytree(self.folder / "lib", other / "lib")
        shutil.copy(self.folder / "m.yaml", other)
        self.expect(0, "run", "-j", "7", os.path.join("else where", "m.yaml"))
        self.assertEqual(files_below(other / "out"), before)

    def test_a_run_from_another_folder_knows_what_is_up_to_date(self):
        self.expect(0, "run", "m.yaml")
        done = self.expect(0, "run", self.folder / "m.yaml", cwd="/")
        self.assertIn("4 up to date", done.err)
        self.expect(0, "verify", self.folder / "out", cwd="/")

    def test_dry_run_and_check_write_nothing(self):
        for arguments in (("run", "-n", "m.yaml"), ("run", "--dry-run", "m.yaml"), ("check", "m.yaml")):
            self.expect(0, *arguments)
            self.assertFalse((self.folder / "out").exists())
        self.expect(0, "run", "m.yaml")
        write_hdr(self.folder / "lib/p00.hdr", 77)
        before = {path: path.read_bytes() for path in (self.folder / "out").rglob("*") if path.is_file()}
        self.expect(0, "run", "-n", "m.yaml")
        self.expect(0, "check", "m.yaml")
        after = {path: path.read_bytes() for path in (self.folder / "out").rglob("*") if path.is_file()}
        self.assertEqual(after, before)

    def test_explain(self):
        self.expect(0, "run", "m.yaml")
        self.assertNotIn("runs:", self.expect(0, "run", "--explain", "m.yaml").err)
        write_hdr(self.folder / "lib/p02.hdr", 78)
        os.utime(self.folder / "lib/p02.hdr", ns=(1, 1))
        write_hdr(self.folder / "lib/p04.hdr", 79)
        (self.folder / "out/maps/p03.irradiance.exr").unlink()
        done = self.expect(0, "run", "--explain", "m.yaml")
        told = [line for line in done.err.splitlines() if line.startswith("runs:")]
        self.assertEqual(told, ["runs: p02 (its file's content changed)",
                                "runs: p03 (a file that it wrote is missing or has another size)",
                                "runs: p04 (new)"])
        done = self.expect(0, "run", "--explain", "--degree", "3", "--only", "p00", "m.yaml")
        self.assertIn("runs: p00 (its parameters changed)", done.err)

    def test_check_says_what_would_be_done(self):
        self.expect(0, "run", "m.yaml")
        (self.folder / "out/maps/p03.irradiance.exr").unlink()
        out = self.expect(0, "check", "m.yaml").out
        self.assertRegex(out, r"(?m)^skip +p00  \(up to date\)$")
        self.assertRegex(out, r"(?m)^write +p03  \(a file")
        self.assertIn("0 to project, 1 to write files of, 3 up to date", out)

    def test_a_changed_map_request_decodes_nothing(self):
        self.expect(0, "run", "m.yaml")
        self.write_manifest("tables: [csv, json, npy]\n" + MAPS.replace("16, 8", "20, 10"))
        err = self.expect(0, "run", "--progress", "json", "m.yaml").err
        self.assertEqual(json.loads(err.splitlines()[-1])["pixels"], 0)
        incremental = self.outputs()
        shutil.rmtree(self.folder / "out")
        self.expect(0, "run", "m.yaml")
        self.assertEqual(self.outputs(), incremental)

    def test_verify_inputs(self):
        self.expect(0, "run", "m.yaml")
        path = self.folder / "lib/p00.hdr"
        stat = path.stat()
        write_hdr(path, 80)
        os.utime(path, ns=(stat.st_atime_ns, stat.st_mtime_ns))
        self.assertIn("4 up to date", self.expect(0, "run", "m.yaml").err)
        self.assertIn("1 panorama done", self.expect(0, "run", "--verify-inputs", "m.yaml").err)


class Overrides(ShoalTest):
    def setUp(self):
        super().setUp()
        self.make_library(3)

    def rows(self):
        return list(csv.DictReader(io.StringIO(self.table().decode())))

    def test_table_format(self):
        self.expect(0, "run", "m.yaml")
        self.assertTrue(self.table().startswith(b"panorama,variant,quantity,l,m,r,g,b\np00,plain,radiance,0,0,"))
        rows = self.rows()
        self.assertEqual([(row["panorama"], row["quantity"]) for row in rows[::9]],
                         [(f"p{i:02}", quantity) for i in range(3) for quantity in ("radiance", "irradiance")])
        for row in rows:
            for channel in "rgb":
                self.assertEqual(row[channel], "%.17g" % float(row[channel]))

    def test_a_run_says_what_project_says(self):
        self.expect(0, "run", "m.yaml")
        of_run = [[row[key] for key in "lmrgb"] for row in self.rows() if row["quantity"] == "radiance"]
        out = self.expect(0, "project", "lib/p00.hdr", "lib/p01.exr", "lib/p02.hdr").out
        self.assertEqual(of_run, [line.split(",")[2:] for line in out.splitlines()[1:]])

    def test_degree_quantity_and_quadrature(self):
        self.expect(0, "run", "--degree", "5", "--quantity", "irradiance-over-pi", "--quadrature", "fejer", "m.yaml")
        rows = self.rows()
        self.assertEqual(len(rows), 3 * 36)
        self.assertEqual({row["quantity"] for row in rows}, {"irradiance-over-pi"})
        out = self.expect(0, "project", "--degree", "5", "--quantity", "irradiance-over-pi", "--quadrature", "fejer",
                          "lib/p00.hdr").out
        self.assertEqual([[row[key] for key in "lmrgb"] for row in rows[:36]],
                         [line.split(",")[2:] for line in out.splitlines()[1:]])

    def test_frame_wins_over_the_manifest(self):
        self.write_manifest("variants: {a: {frame: native}, b: {}}\nquantities: [radiance]\n")
        self.expect(0, "run", "--frame", "openexr", "m.yaml")
        rows = self.rows()
        out = self.expect(0, "project", "--frame", "openexr", "lib/p00.hdr").out
        expected = [line.split(",")[2:] for line in out.splitlines()[1:]]
        for first in (0, 9):
            self.assertEqual([[row[key] for key in "lmrgb"] for row in rows[first:first + 9]], expected)

    def test_formats(self):
        self.expect(0, "run", "--format", "json", "--format", "npy", "--format", "json", "m.yaml")
        self.assertEqual(sorted(self.outputs()),
                         ["coefficients.json", "coefficients.names.csv", "coefficients.npy"])
        table = json.loads(self.table("coefficients.json"))
        self.assertEqual(len(table["records"]), 6)
        data = self.table("coefficients.npy")
        self.assertEqual(data[:8], b"\x93NUMPY\x01\x00")
        start = 10 + struct.unpack("<H", data[8:10])[0]
        self.assertIn(b"(6, 9, 3)", data[:start])
        numbers = struct.unpack(f"<{6 * 27}d", data[start:])
        flat = [n for record in table["records"] for triple in record["coefficients"] for n in triple]
        self.assertEqual(list(numbers), flat)
        names = self.table("coefficients.names.csv").decode().splitlines()
        self.assertEqual(names[0], "index,panorama,variant,quantity")
        self.assertEqual(names[1], "0,p00,plain,radiance")

    def test_reference(self):
        self.expect(0, "run", "--reference", "--only", "p00", "m.yaml")
        out = self.expect(0, "project", "--reference", "lib/p00.hdr").out
        self.assertEqual([[row[key] for key in "lmrgb"] for row in self.rows()[:9]],
                         [line.split(",")[2:] for line in out.splitlines()[1:]])

    def test_only(self):
        self.write("m.yaml", 'shoal: 1\noutput: out\npanoramas:\n  - {files: "lib/*.hdr", tags: [radiance]}\n'
                             '  - {files: "lib/*.exr", tags: [openexr]}\n')
        done = self.expect(0, "run", "--only", "openexr", "m.yaml")
        self.assertIn("1 panorama done", done.err)
        self.assertIn("2 panoramas of the manifest not in the tables", done.err)
        self.assertEqual({row["panorama"] for row in self.rows()}, {"p01"})
        self.expect(0, "run", "--only", "p0[02]", "m.yaml")
        self.assertEqual([row["panorama"] for row in self.rows()[::18]], ["p00", "p02", "p01"], "manifest order")
        self.assertIn("3 up to date", self.expect(0, "run", "m.yaml").err)

    def test_set(self):
        self.write("m.yaml", 'shoal: 1\nvars: {where: nowhere, l: 1}\noutput: "${place}"\n'
                             'panoramas: [{files: "${where}/*.hdr", degree: "${l}"}]\n')
        self.expect(2, "run", "m.yaml")
        self.expect(0, "run", "--set", "where=lib", "--set", "place=a=b", "--set", "l=4", "m.yaml")
        table = (self.folder / "a=b/coefficients.csv").read_text()
        self.assertEqual(len(table.splitlines()), 1 + 2 * 2 * 25)

    def test_options_that_repeat_take_one_value_each(self):
        self.expect(0, "run", "--quantity", "radiance", "m.yaml")
        self.expect(0, "run", "--format", "json", "m.yaml")
        self.write_manifest("vars: {a: c}\n")
        self.expect(0, "run", "--set", "a=b", "m.yaml")


if __name__ == "__main__":
    support.main()
