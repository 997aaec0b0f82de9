"""A display of one's own: Xvfb, keys and mouse pressed on it, and what it shows. No window manager.

Keys are pressed by XTest, as hardware would press them, so the program under test cannot tell the difference.
"""

import ctypes
import os
import shutil
import subprocess
import time

SHIFTED = {"plus", "E"}
KEY_NAMES = {"+": "plus", "-": "minus"}


class _Image(ctypes.Structure):
    """The head of Xlib's XImage."""
    _fields_ = [("width", ctypes.c_int), ("height", ctypes.c_int), ("xoffset", ctypes.c_int),
                ("format", ctypes.c_int), ("data", ctypes.POINTER(ctypes.c_char)),
                ("byte_order", ctypes.c_int), ("bitmap_unit", ctypes.c_int), ("bitmap_bit_order", ctypes.c_int),
                ("bitmap_pad", ctypes.c_int), ("depth", ctypes.c_int), ("bytes_per_line", ctypes.c_int),
                ("bits_per_pixel", ctypes.c_int)]


def _libraries():
    """Xlib and XTest, or None where one is missing."""
    try:
        x, test = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
    except OSError:
        return None
    pointer, number, window = ctypes.c_void_p, ctypes.c_int, ctypes.c_ulong
    for function, result, *arguments in (
            (x.XOpenDisplay, pointer, ctypes.c_char_p), (x.XCloseDisplay, number, pointer),
            (x.XDefaultRootWindow, window, pointer), (x.XFree, number, pointer),
            (x.XSync, number, pointer, number), (x.XAutoRepeatOff, number, pointer),
            (x.XStringToKeysym, window, ctypes.c_char_p), (x.XKeysymToKeycode, ctypes.c_ubyte, pointer, window),
            (x.XQueryTree, number, pointer, window, ctypes.POINTER(window), ctypes.POINTER(window),
             ctypes.POINTER(ctypes.POINTER(window)), ctypes.POINTER(ctypes.c_uint)),
            (x.XFetchName, number, pointer, window, ctypes.POINTER(pointer)),
            (x.XResizeWindow, number, pointer, window, ctypes.c_uint, ctypes.c_uint),
            (x.XGetImage, ctypes.POINTER(_Image), pointer, window, number, number, ctypes.c_uint, ctypes.c_uint,
             window, number),
            (x.XDestroyImage, number, ctypes.POINTER(_Image)),
            (test.XTestFakeKeyEvent, number, pointer, ctypes.c_uint, number, window),
            (test.XTestFakeButtonEvent, number, pointer, ctypes.c_uint, number, window),
            (test.XTestFakeMotionEvent, number, pointer, number, number, number, window)):
        function.restype, function.argtypes = result, arguments
    return x, test


def missing():
    """What there is not, in words; empty where a display can be had."""
    if not shutil.which("Xvfb"):
        return "Xvfb is not there"
    return "" if _libraries() else "libX11 or libXtst is not there"


class Display:
    def __init__(self, width, height):
        self.width, self.height = width, height
        self.x, self.test = _libraries()
        reading, writing = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp"],
            pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as answer:
            self.name = ":" + answer.readline().strip()
        self.connection = self.x.XOpenDisplay(self.name.encode())
        if not self.connection:
            raise RuntimeError(f"Xvfb does not answer as {self.name}")
        self.x.XAutoRepeatOff(self.connection)  # a busy machine may be late to let go of a key
        self.root = self.x.XDefaultRootWindow(self.connection)

    def close(self):
        self.x.XCloseDisplay(self.connection)
        self.server.terminate()
        self.server.wait(30)

    def press(self, key):
        """A key by its character. Without a window manager it goes to the window under the pointer."""
        name = KEY_NAMES.get(key, key)
        code = self.x.XKeysymToKeycode(self.connection, self.x.XStringToKeysym(name.encode()))
        shift = self.x.XKeysymToKeycode(self.connection, self.x.XStringToKeysym(b"Shift_L"))
        held = [shift, code] if name in SHIFTED else [code]
        for down, codes in ((1, held), (0, held[::-1])):
            for each in codes:
                self.test.XTestFakeKeyEvent(self.connection, each, down, 0)
        self.x.XSync(self.connection, 0)

    def point(self, x, y):
        self.test.XTestFakeMotionEvent(self.connection, 0, x, y, 0)
        self.x.XSync(self.connection, 0)

    def drag(self, start, end, button=1):
        self.point(*start)
        self.test.XTestFakeButtonEvent(self.connection, button, 1, 0)
        for step in range(1, 5):
            self.point(*(a + (b - a) * step // 4 for a, b in zip(start, end)))
        self.test.XTestFakeButtonEvent(self.connection, button, 0, 0)
        self.x.XSync(self.connection, 0)

    def windows(self):
        """The windows on the screen."""
        ignored, children, count = ctypes.c_ulong(), ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        self.x.XQueryTree(self.connection, self.root, ignored, ignored, children, count)
        found = [children[i] for i in range(count.value)]
        if children:
            self.x.XFree(children)
        return found

    def titles(self):
        found = []
        for window in self.windows():
            text = ctypes.c_void_p()
            if self.x.XFetchName(self.connection, window, text) and text.value:
                found.append(ctypes.string_at(text.value).decode("utf-8", "replace"))
                self.x.XFree(text)
        return found

    def resize(self, width, height):
        """The only window."""
        self.x.XResizeWindow(self.connection, self.windows()[0], width, height)
        self.x.XSync(self.connection, 0)

    def picture(self, width, height):
        """The upper left part of the screen: 8-bit RGB, rows from the top."""
        all_planes, z_pixmap = 2**64 - 1, 2
        image = self.x.XGetImage(self.connection, self.root, 0, 0, width, height, all_planes, z_pixmap)
        row, size = image.contents.bytes_per_line, 4 * width
        data = ctypes.string_at(image.contents.data, row * height)
        self.x.XDestroyImage(image)
        rows = b"".join(data[row * y:row * y + size] for y in range(height))  # blue, green, red, nothing
        rgb = bytearray(3 * width * height)
        rgb[0::3], rgb[1::3], rgb[2::3] = rows[2::4], rows[1::4], rows[0::4]
        return bytes(rgb)


def wait_until(condition, what, seconds=60.0):
    """The first true answer; an AssertionError where there is none in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = condition()
        if answer:
            return answer
        time.sleep(0.03)
    raise AssertionError(f"after {seconds} seconds: {what}")
