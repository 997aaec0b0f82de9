"""What the end-to-end tests share: the program, and libraries of panoramas made on the spot."""

import hashlib
import os
import pathlib
import pty
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

SKIPPED = 77  # as ctest is told in SKIP_RETURN_CODE
BINARY = os.environ.get("SHOAL_BINARY", "")
DATA = pathlib.Path(os.environ.get("SHOAL_TEST_DATA", "") or "/nonexistent")

ESCAPE = "\x1b"
STYLE = re.compile(re.escape(ESCAPE) + r"\[[0-9;]*m")  # of letters on a terminal

TEMPORARY_MARK = ".shoal-tmp-"
STORE = "shoal.db"


class Done:
    """How a call of the program ended."""

    def __init__(self, status, out, err):
        self.status = status
        self.out = out
        self.err = err

    def __repr__(self):
        return f"exit status {self.status}\n--- stdout\n{self.out}\n--- stderr\n{self.err}"


def plain_environment(**more):
    kept = {name: value for name, value in os.environ.items() if name in ("PATH", "HOME", "TMPDIR")}
    # Sanitizers report on stderr and have their own exit status, whatever the test expects.
    kept.update({name: value for name, value in os.environ.items() if name.endswith("SAN_OPTIONS")})
    kept.update(more)
    return kept


def shoal(*arguments, cwd=None, env=None, timeout=120, **more):
    """Runs the program to its end. Bytes that are not UTF-8 come as surrogates."""
    result = subprocess.run(
        [BINARY, *map(os.fspath, arguments)], cwd=cwd, env=env or plain_environment(),
        stdin=subprocess.DEVNULL, capture_output=True, timeout=timeout, **more)
    def decode(data):
        return data.decode("utf-8", "surrogateescape")
    return Done(result.returncode, decode(result.stdout), decode(result.stderr))


def start(*arguments, cwd=None, **more):
    """Starts the program and returns at once."""
    return subprocess.Popen(
        [BINARY, *map(os.fspath, arguments)], cwd=cwd, env=plain_environment(),
        stdin=subprocess.DEVNULL, **more)


def rgbe_bytes(width, height, texels):
    """A Radiance picture with flat scanlines."""
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    return header.encode() + texels


def write_constant_hdr(path, mantissas, exponent, width=16, height=8):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(rgbe_bytes(width, height, bytes([*mantissas, exponent]) * (width * height)))


def write_hdr(path, seed, width=32, height=16):
    """Noise over some orders of magnitude; another picture for every seed."""
    noise = random.Random(seed)
    texels = bytearray()
    for _ in range(width * height):
        bits = noise.getrandbits(32)
        # Mantissas from 128 up: normalised, and never the mark 2 2 of a packed scanline.
        texels += bytes([128 | bits & 127, 128 | bits >> 7 & 127, 128 | bits >> 14 & 127,
                         122 + (bits >> 21) % 12])
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(rgbe_bytes(width, height, bytes(texels)))


def write_exr(path, seed, width=32, height=16, envmap=None):
    """OpenEXR, float, not compressed: one scanline a chunk. envmap: 0 is LATLONG, 1 CUBE."""
    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data
    channels = b"".join(name + b"\0" + struct.pack("<iBxxxii", 2, 0, 1, 1) for name in (b"B", b"G", b"R"))
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2)
    header += attribute("channels", "chlist", channels + b"\0")
    header += attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", window)
    header += attribute("displayWindow", "box2i", window)
    header += attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    if envmap is not None:
        header += attribute("envmap", "envmap", bytes([envmap]))
    header += b"\0"
    noise = random.Random(seed)
    row_size = 3 * width * 4
    first = len(header) + 8 * height
    table = b"".join(struct.pack("<Q", first + row * (8 + row_size)) for row in range(height))
    chunks = b""
    for row in range(height):
        samples = [noise.random() * 8 for _ in range(3 * width)]
        chunks += struct.pack("<ii", row, row_size) + struct.pack(f"<{3 * width}f", *samples)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(header + table + chunks)


def write_png(path, width=16, height=8):
    """An 8-bit grey-to-colour ramp."""
    def chunk(kind, data):
        checksum = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", checksum)
    rows = b"".join(b"\0" + bytes((7 * x + 13 * y + 50 * c) % 256 for x in range(width) for c in range(3))
                    for y in range(height))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def files_below(folder):
    """Every file but the store, by its path in the folder, as a hash of its content."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and not name.startswith(STORE):
            found[name] = hashlib.sha256(path.read_bytes()).hexdigest()
    return found


def is_temporary(name):
    return TEMPORARY_MARK in name


class ShoalTest(unittest.TestCase):
    """A test with a folder of its own, self.folder, in which the program runs."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shoal-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def shoal(self, *arguments, **more):
        more.setdefault("cwd", self.folder)
        return shoal(*arguments, **more)

    def shoal_on_terminal(self, *arguments, **environment):
        """Runs the program on a terminal: all that it says is in `out`."""
        master, slave = pty.openpty()
        process = subprocess.Popen(
            [BINARY, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=slave, stderr=slave,
            env=plain_environment(**{"TERM": "xterm-256color", **environment}))
        os.close(slave)
        text = b""
        while True:
            try:
                piece = os.read(master, 4096)
            except OSError:  # the other end is closed
                break
            if not piece:
                break
            text += piece
        os.close(master)
        return Done(process.wait(60), text.decode(), "")

    def expect(self, status, *arguments, **more):
        """Runs the program, which must end with this status."""
        done = self.shoal(*arguments, **more)
        self.assertEqual(done.status, status, f"shoal {' '.join(map(str, arguments))}\n{done}")
        return done

    def make_library(self, count=3, **size):
        """lib/p00.hdr, lib/p01.exr, lib/p02.hdr ... and m.yaml, which names them all."""
        for index in range(count):
            write = write_exr if index % 4 == 1 else write_hdr
            extension = "exr" if index % 4 == 1 else "hdr"
            write(self.folder / f"lib/p{index:02}.{extension}", index, **size)
        self.write_manifest()

    def write_manifest(self, more=""):
        self.write("m.yaml", 'shoal: 1\noutput: out\npanoramas: [{files: "lib/**/*.{hdr,exr}"}]\n' + more)

    def outputs(self):
        return files_below(self.folder / "out")

    def table(self, name="coefficients.csv"):
        return (self.folder / "out" / name).read_bytes()


def main():
    if not BINARY:
        print("skipped: SHOAL_BINARY does not name the program")
        sys.exit(SKIPPED)
    result = unittest.main(exit=False).result
    if not result.wasSuccessful():
        sys.exit(1)
    sys.exit(SKIPPED if result.testsRun == len(result.skipped) else 0)
