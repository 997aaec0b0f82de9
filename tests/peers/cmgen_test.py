#!/usr/bin/env python3
"""Nine coefficients against cmgen, the light-probe baker of Google's Filament (Debian's libfilament-tools).

    cmgen_test.py MadePicture | RealPanoramas

cmgen resamples a panorama to a cube map and sums over that; it was written by others, in another frame and
with other signs. So what this shows is that scale, signs, order and axes are right; not the last digits:

- It prints L_lm with the Condon-Shortley sign (-1)^m; with --sh-irradiance A_l L_lm, in this version without
  a factor of 1/pi. --sh-window=no keeps it from damping degrees 1 and 2.
- It reads a Radiance mantissa m as (m + 1/2)/256: `rgbe_decode: center`.
- It looks (u, v) in [0, 1)^2 up at the whole parts of u (W - 1) and v (H - 1). So the last row and the last
  column are never seen and the rest is stretched over their place: the horizon sinks by half a pixel.
- It takes about as many samples as there are pixels, the first one in the corner of a texel of the cube. So
  a sun of a few pixels comes out too large or too small, and everything is shifted by a fraction of a texel.

Frames: it looks at the picture's centre along +z, with +x to the right in the picture (--no-mirror), or to
the left, as one sees it from inside (default).
"""
import csv
import itertools
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor

CMGEN = shutil.which("cmgen")
SHOAL = os.environ.get("SHOAL_BINARY")
DATA = pathlib.Path(os.environ.get("SHOAL_TEST_DATA", ""))

INDICES = [(l, m) for l in range(3) for m in range(-l, l + 1)]
LINE = re.compile(r"\(\s*(\S+),\s*(\S+),\s*(\S+)\); // L(\d)(-?\d)(.*)")
SKIPPED = 77  # exit status that ctest takes for "skipped"

# The fixed frames by their names, and all 48 that there are by their axes: centre, right, up.
RIGHT_AXES = {"cmgen-no-mirror": ("+z", "+x", "+y"), "cmgen": ("+z", "-x", "+y")}
ALL_AXES = [tuple(sign + axis for sign, axis in zip(signs, axes))
            for axes in itertools.permutations("xyz") for signs in itertools.product("+-", repeat=3)]


def variant_of(axes):
    return "".join(axes).replace("+", "p").replace("-", "m")


def output_of(command):
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        raise AssertionError(f"{command} exits {run.returncode}: {run.stderr}")
    return run.stdout


def run_cmgen(path, *options):
    """What cmgen prints for a panorama, (l, m) -> (r, g, b) with its own signs, and its remarks."""
    command = [CMGEN, "--sh=3", "--sh-window=no", *options, str(path)]
    text = output_of(command)
    values, remarks = {}, set()
    for r, g, b, l, m, remark in LINE.findall(text):
        values[int(l), int(m)] = (float(r), float(g), float(b))
        remarks.add(remark)
    if sorted(values) != sorted(INDICES) or len(remarks) != 1:
        raise AssertionError(f"not nine coefficients: {text}")
    return values, remarks.pop()


def run_shoal(folder, panoramas):
    """(panorama, variant, quantity) -> (l, m) -> (r, g, b), in every frame there is."""
    frames = [f"  {name}: {{frame: {name}}}" for name in RIGHT_AXES]
    frames += [f'  {variant_of(axes)}: {{frame: "{",".join(axes)}"}}' for axes in ALL_AXES]
    manifest = folder / "manifest.yaml"
    manifest.write_text("\n".join([
        "shoal: 1",
        "output: out",
        "defaults: {degree: 2, quadrature: texel, rgbe_decode: center}",
        "panoramas:",
        *[f'  - file: "{path}"' for path in panoramas],
        "variants:",
        *frames,
        "quantities: [radiance, irradiance]",
        "tables: [csv]",
    ]) + "\n")
    output_of([SHOAL, "run", "--progress", "none", str(manifest)])
    tables = {}
    with open(folder / "out" / "coefficients.csv", newline="") as stream:
        for row in csv.DictReader(stream):
            table = tables.setdefault((row["panorama"], row["variant"], row["quantity"]), {})
            table[int(row["l"]), int(row["m"])] = tuple(float(row[c]) for c in "rgb")
    return tables


def without_phase(values):
    return {(l, m): tuple((-1) ** m * v for v in rgb) for (l, m), rgb in values.items()}


def difference(mine, peer):
    """The largest of all coefficients and channels, in L_00 of the channel."""
    return max(abs(mine[i][c] - peer[i][c]) / mine[0, 0][c] for i in INDICES for c in range(3))


class Comparison(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def check(self, tables, name, quantity, frame, printed, tolerance):
        """cmgen's coefficients are shoal's with the phase, in that frame and in no other of the 48."""
        mine = tables[name, frame, quantity]
        peer = without_phase(printed)
        self.assertEqual(mine, tables[name, variant_of(RIGHT_AXES[frame]), quantity])
        self.assertLessEqual(difference(mine, peer), tolerance, f"{name} {frame}")
        self.assertGreater(difference(mine, printed), 2 * tolerance, f"{name}: no Condon-Shortley phase?")
        for axes in ALL_AXES:
            if axes != RIGHT_AXES[frame]:
                wrong = tables[name, variant_of(axes), quantity]
                self.assertGreater(difference(wrong, peer), 2 * tolerance, f"{name} {frame}: {axes} fits, too")


class MadePicture(Comparison):
    """Smooth light, and only those rows and columns for shoal that cmgen sees."""

    WIDTH, HEIGHT = 512, 256
    # Unit direction in the native frame, colour. No axis is like another, in no channel.
    LOBES = [((0.8, 0.36, 0.48), (5.0, 3.0, 1.0)), ((-0.48, 0.6, -0.64), (1.0, 2.0, 4.0)),
             ((0.28, -0.96, 0.0), (0.5, 3.0, 2.0))]
    # With 16 samples in a texel of the cube, and 32 texels along its edge, these are shifted by 0.1 degrees.
    SIZE = "--size=32"
    TOLERANCE = 2e-3

    def radiance(self, row, column):
        theta = math.pi * (row + 0.5) / self.HEIGHT
        phi = 2 * math.pi * (column + 0.5) / self.WIDTH
        x, y, z = math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)
        colour = [0.3, 0.4, 0.5]
        for (a, b, c), lobe in self.LOBES:
            gain = math.exp(2.0 * (a * x + b * y + c * z - 1.0))
            colour = [value + gain * extra for value, extra in zip(colour, lobe)]
        return colour

    @staticmethod
    def texel(colour):
        exponent = math.frexp(max(colour))[1]
        return bytes(int(value * 2.0 ** (8 - exponent)) for value in colour) + bytes([exponent + 128])

    def write(self, name, rows):
        path = self.folder / name
        header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {len(rows)} +X {len(rows[0])}\n"
        path.write_bytes(header.encode() + b"".join(b"".join(row) for row in rows))
        return path

    def test_frames_signs_and_quantities(self):
        rows = [[self.texel(self.radiance(i, j)) for j in range(self.WIDTH)] for i in range(self.HEIGHT)]
        whole = self.write("whole.hdr", rows)
        seen = self.write("seen.hdr", [row[:-1] for row in rows[:-1]])
        tables = run_shoal(self.folder, [seen])
        for quantity, option, expected in (("radiance", [], ""),
                                           ("irradiance", ["--sh-irradiance"], ", irradiance")):
            for frame, mirror in (("cmgen-no-mirror", ["--no-mirror"]), ("cmgen", [])):
                with self.subTest(quantity=quantity, frame=frame):
                    printed, remark = run_cmgen(whole, self.SIZE, *mirror, *option)
                    self.assertEqual(remark, expected)
                    self.check(tables, "seen", quantity, frame, printed, self.TOLERANCE)


class RealPanoramas(Comparison):
    # With the usual 256 texels along an edge, small suns lose or gain up to 3 % of all light.
    SIZE = "--size=512"
    TOLERANCE = 0.02
    MIRRORED = ("city", "sky", "venice")

    @unittest.skipUnless((DATA / "pmndrs_hdr").is_dir(), f"no real panoramas in '{DATA}'; set SHOAL_TEST_DATA")
    def test_all(self):
        panoramas = sorted((DATA / "pmndrs_hdr").resolve().glob("*.hdr"))
        self.assertGreater(len(panoramas), 0)
        jobs = [(path, "radiance", "cmgen-no-mirror", ["--no-mirror"]) for path in panoramas]
        jobs += [(path, "irradiance", "cmgen", ["--sh-irradiance"]) for path in panoramas
                 if path.stem in self.MIRRORED]
        tables = run_shoal(self.folder, panoramas)
        with ThreadPoolExecutor(2) as pool:
            outputs = pool.map(lambda job: run_cmgen(job[0], self.SIZE, *job[3])[0], jobs)
            for (path, quantity, frame, _), printed in zip(jobs, outputs):
                with self.subTest(panorama=path.stem, quantity=quantity, frame=frame):
                    self.check(tables, path.stem, quantity, frame, printed, self.TOLERANCE)


def main():
    if not CMGEN or not SHOAL:
        print("skipped:", "cmgen not found (libfilament-tools)" if SHOAL else "SHOAL_BINARY is not set")
        return SKIPPED
    result = unittest.main(exit=False, verbosity=2).result
    if result.wasSuccessful() and result.skipped:
        return SKIPPED
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
