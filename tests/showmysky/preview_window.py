#!/usr/bin/env python3
"""The window of showmysky as people use it: a real window on a screen in memory (Xvfb), hands made by xdotool, and
screenshots that are compared.
    preview_window.py SHOWMYSKY CALCMYSKY MODEL DESCRIPTION SCRATCH [SLOWNESS]
SLOWNESS stretches all pauses and all patience: for programs under a sanitizer, whose frames take longer.
Exit code 77: skipped, because Xvfb, xdotool or NumPy is missing. Screenshots of every step stay in SCRATCH."""

import os
import shutil
import struct
import subprocess
import sys
import time
import zlib

SKIPPED = 77
WIDTH, HEIGHT = 900, 600
PANEL, STATUS = 345, 60  # what widgets cover at the left and at the bottom, pixels
ADD_A_CITY, LUMINANCE, REMOVE = (47, 522), (100, 472), (30, 495)  # widgets, once the panel is scrolled to its end
SLOWNESS = float(sys.argv[6]) if len(sys.argv) > 6 else 1
PATIENCE = 20 * SLOWNESS  # seconds for anything to happen on a busy machine

try:
    import numpy as np
except ImportError:
    print("SKIPPED: NumPy is missing (Debian: python3-numpy).")
    sys.exit(SKIPPED)
for program, package in (("Xvfb", "xvfb"), ("xdotool", "xdotool")):
    if not shutil.which(program):
        print(f"SKIPPED: {program} is missing (Debian: {package}).")
        sys.exit(SKIPPED)

SHOWMYSKY, CALCMYSKY, MODEL, DESCRIPTION, SCRATCH = (os.path.abspath(path) for path in sys.argv[1:6])


class Failure(Exception):
    pass


def pause(seconds):
    time.sleep(seconds * SLOWNESS)


def expect(condition, sentence):
    if not condition:
        raise Failure(sentence)


def write_png(path, image):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width = image.shape[:2]
    rows = b"".join(b"\0" + row.tobytes() for row in image)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b""))


class Screen:
    """A screen in memory; its content is a file in the format of xwd(1)."""

    def __init__(self, directory):
        os.makedirs(directory)
        reading, writing = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", directory, "-noreset", "-nolisten", "tcp"],
            pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            self.display = ":" + pipe.readline().strip()
        expect(self.display != ":", "Xvfb did not start")
        self.file = os.path.join(directory, "Xvfb_screen0")

    def look(self):
        """[height][width][red, green, blue]"""
        with open(self.file, "rb") as file:
            data = file.read()
        header = struct.unpack(">25I", data[:100])
        start, width, height, row, colours = header[0] + 12 * header[19], header[4], header[5], header[12], header[19]
        pixels = np.frombuffer(data[start:start + row * height], np.uint8).reshape(height, row // 4, 4)
        return np.ascontiguousarray(pixels[:, :width, 2::-1])

    def close(self):
        self.server.terminate()
        self.server.wait()


class Hands:
    def __init__(self, display):
        self.environment = dict(os.environ, DISPLAY=display)

    def do(self, *words):
        subprocess.run(["xdotool", *(str(word) for word in words)], env=self.environment, check=True,
                       stdout=subprocess.DEVNULL)
        pause(0.05)  # a frame: one that sees two places of the pointer knows the last alone

    def rest(self):
        """The pointer leaves the sky: it would show in the screenshots."""
        self.do("mousemove", 2, HEIGHT - 2)

    def drag(self, start, end, button=1, key=None):
        self.do("mousemove", *(round(a) for a in start))
        if key:
            self.do("keydown", key)
        self.do("mousedown", button)
        for share in (0.25, 0.5, 0.75, 1):
            self.do("mousemove", *(round(a + share * (b - a)) for a, b in zip(start, end)))
        self.do("mouseup", button)
        if key:
            self.do("keyup", key)
        self.rest()

    def hold(self, *keys):
        """Long enough for the slowest frame: Dear ImGui 1.86 misses keys that are up again before it looks."""
        for key in keys:
            self.do("keydown", key)
        pause(0.5)
        for key in reversed(keys):
            self.do("keyup", key)

    def press(self, place):
        """A click as long as hold() holds keys."""
        self.do("mousemove", *place)
        pause(0.3)
        self.do("mousedown", 1)
        pause(0.5)
        self.do("mouseup", 1)
        pause(0.3)
        self.rest()

    def click(self, place, button=1, times=1):
        self.do("mousemove", *place)
        for _ in range(times):
            self.do("click", button)
        self.rest()


class Window:
    """showmysky, running."""

    def __init__(self, screen, *arguments):
        self.screen = screen
        self.hands = Hands(screen.display)
        self.log = open("showmysky.log", "w+")
        self.hands.rest()
        self.process = subprocess.Popen([SHOWMYSKY, *arguments], stdout=self.log, stderr=self.log,
                                        env=dict(os.environ, DISPLAY=screen.display))

    def wait(self, condition, what, patience=PATIENCE):
        """Until the condition holds for a screenshot and nothing moves any more."""
        deadline = time.monotonic() + patience
        before = self.screen.look()
        still = 0
        while time.monotonic() < deadline:
            pause(0.12)
            now = self.screen.look()
            still = still + 1 if np.array_equal(before, now) else 0
            if self.process.poll() is not None:
                self.log.seek(0)
                raise Failure(f"showmysky ended with {self.process.returncode} while waiting until {what}: " + self.log.read())
            if still >= 4 and condition(now):
                write_png(what.replace(" ", "-") + ".png", now)
                return now
            before = now
        write_png("at-failure.png", before)
        raise Failure(f"in {patience:g} s it never came true that {what}; see at-failure.png")

    def appears(self, night=False):
        def seen(image):  # beside the panel it is grey before there is a sky, and black at night
            return image[:40, :PANEL].max() > 200 and np.median(sky(image)) == 0 if night else np.median(sky(image)) > 50

        image = self.wait(seen, "the sky appears")
        window = subprocess.run(["xdotool", "search", "--pid", str(self.process.pid)], env=self.hands.environment,
                                capture_output=True, text=True, check=True).stdout.split()[-1]
        self.hands.do("windowfocus", window)
        return image

    def quit(self):
        self.hands.do("key", "ctrl+q")
        code = self.process.wait(PATIENCE)
        self.log.seek(0)
        expect(code == 0, f"Ctrl+Q ended with exit code {code}: " + self.log.read())

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.log.close()


def sky(image):
    """What no widget covers."""
    return image[:HEIGHT - STATUS, PANEL:].astype(int)


def difference(one, other):
    """Largest difference of two parts of screenshots, in levels."""
    return int(np.abs(one.astype(int) - other.astype(int)).max())


def sun(image):
    """Where the sky is brightest, pixels of the window."""
    brightness = sky(image).sum(axis=2)
    rows, columns = np.nonzero(brightness >= brightness.max() - 6)
    return np.array([columns.mean() + PANEL, rows.mean()])


def place(point, field_of_view, pitch):
    """Azimuth and zenith angle under a point of a perspective that looks North, degrees."""
    scale = np.tan(np.radians(field_of_view / 2)) / (WIDTH / 2)
    right, up = (point[0] - WIDTH / 2) * scale, (HEIGHT / 2 - point[1]) * scale
    pitch = np.radians(pitch)
    north, above = np.cos(pitch) - up * np.sin(pitch), np.sin(pitch) + up * np.cos(pitch)
    return np.degrees([np.arctan2(right, north), np.arctan2(np.hypot(right, north), above)])


def preferences(**lines):
    os.makedirs("config/showmysky", exist_ok=True)
    with open("config/showmysky/preview.conf", "w") as file:
        file.writelines(f"{name.replace('_', '-')}: {value}\n" for name, value in lines.items())


def test_scene(screen):
    """The Sun, the camera, the wheel, a click, typing, a bare picture, a restart."""
    preferences(window_width=WIDTH, window_height=HEIGHT, dithering="none", sun_zenith=60, sun_azimuth=15, pitch=30)
    window = Window(screen, "model")
    try:
        hands = window.hands
        start = window.appears()
        move = np.array([120, -60])

        hands.drag(sun(start), sun(start) + move, key="ctrl")
        dragged = window.wait(lambda image: np.abs(sun(image) - sun(start) - move).max() < 4, "the Sun moved")

        hands.drag((500, 300), (440, 340), key="shift")
        window.wait(lambda image: np.abs(sun(image) - sun(dragged) - (-60, 40)).max() < 30, "the camera turned")

        hands.drag((500, 300), (560, 260), button=3)
        back = window.wait(lambda image: np.abs(sun(image) - sun(dragged)).max() < 12, "the camera turned back")

        middle = np.array([WIDTH / 2, HEIGHT / 2])
        hands.click((600, 200), button=4, times=3)
        away = np.linalg.norm(sun(back) - middle)
        zoomed = window.wait(lambda image: np.linalg.norm(sun(image) - middle) > 1.5 * away, "the wheel zoomed")

        hands.click((500, 450))
        picked = window.wait(lambda image: difference(sky(image), sky(zoomed)) > 60, "a click showed the light of a pixel")
        hands.do("key", "Escape")
        window.wait(lambda image: difference(sky(image), sky(zoomed)) == 0, "Escape closed it")

        hands.click((60, 81))
        hands.hold("ctrl", "a")
        hands.do("type", "typed.scene")
        hands.hold("Return")
        hands.click((45, 104))
        deadline = time.monotonic() + PATIENCE
        while not os.path.exists("typed.scene") and time.monotonic() < deadline:
            time.sleep(0.1)
        expect(os.path.exists("typed.scene"), "typing a name and pressing Save made no file")
        pause(0.2)
        scene = dict(line.rstrip("\n").split(": ", 1) for line in open("typed.scene") if not line.startswith("#"))
        saved = [float(scene["sun-azimuth"]), float(scene["sun-zenith"])]
        there = place(sun(start) + move, 100, 30)
        expect(np.abs(saved - there).max() < 0.5, f"the scene has a Sun at {saved}, not at {there}")
        expect(abs(float(scene["fov"]) - 72.9) < 0.1, f"the scene has a field of view of {scene['fov']}")

        hands.do("key", "Tab")
        bare = window.wait(lambda image: difference(image[:, 0], image[:, PANEL]) < 60, "Tab hid all chrome")
        expect(difference(sky(bare), sky(zoomed)) == 0, "hiding the chrome changed the picture")
        window.quit()
    finally:
        window.close()

    rendered = subprocess.run([SHOWMYSKY, "render", MODEL, "--scene", "typed.scene", "--size", f"{WIDTH}x{HEIGHT}", "-o", "r.png"],
                              capture_output=True, text=True)
    expect(rendered.returncode == 0, "render did not take the scene: " + rendered.stderr)

    window = Window(screen, "model")
    try:
        again = window.appears()
        expect(difference(sky(again), sky(zoomed)) == 0, "after a restart the picture is another one")
        window.quit()
    finally:
        window.close()


def test_description(screen):
    """A .atmo file is computed and shown, edits are followed, mistakes are told."""
    preferences(window_width=WIDTH, window_height=HEIGHT, dithering="none", exposure=-4, sun_zenith=40)
    text = open(DESCRIPTION).read()
    expect(text.count("\nground albedo:") == 1, "the description has no line for the ground's albedo")
    white = "\n".join("ground albedo: 1" + ", 1" * line.count(",") if line.startswith("ground albedo:") else line
                      for line in text.split("\n"))
    spectra = os.path.join(os.path.dirname(DESCRIPTION), "spectra")
    if os.path.isdir(spectra):
        shutil.copytree(spectra, "spectra")

    def save(content):
        with open("air.atmo", "w") as file:
            file.write(content)

    save(text)
    window = Window(screen, "air.atmo")
    try:
        first = window.appears()
        expect(sky(first)[-1].mean() < 200, "the ground is too bright to become brighter")
        save(white)
        second = window.wait(lambda image: sky(image)[-1].mean() > sky(first)[-1].mean() + 40, "a whiter ground shows")
        save(white.replace("ground albedo", "ground albdo"))
        told = window.wait(lambda image: difference(sky(image), sky(second)) > 100, "a mistake is told")
        expect(difference(sky(told)[-1], sky(second)[-1]) == 0, "with a mistake in the file the former picture went away")
        save(white)
        window.wait(lambda image: difference(sky(image), sky(second)) <= 1, "the mended file shows")
        window.quit()
    finally:
        window.close()


def test_cities(screen):
    """A city is added, made brighter, saved with the scene, and removed, by the widgets at the panel's end."""
    preferences(window_width=WIDTH, window_height=HEIGHT, dithering="none", exposure=1, sun_zenith=130, pitch=10)
    window = Window(screen, "model")
    try:
        hands = window.hands

        def saved_city():
            if os.path.exists("sky.scene"):
                os.remove("sky.scene")
            hands.do("key", "ctrl+s")
            deadline = time.monotonic() + PATIENCE
            while not os.path.exists("sky.scene") and time.monotonic() < deadline:
                time.sleep(0.1)
            pause(0.2)
            scene = dict(line.rstrip("\n").split(":", 1) for line in open("sky.scene") if not line.startswith("#"))
            return dict(part.split("=") for part in scene["city"].strip().split(",") if part)

        def panel_end(what):
            """Scrolls the panel until it goes no farther: on a busy machine turns of the wheel are lost."""
            before = None
            while True:
                hands.do("mousemove", PANEL - 12, 300)  # beside the widgets
                hands.do("click", "--repeat", 20, "--delay", 20, 5)
                hands.rest()
                now = window.wait(lambda image: True, what)
                if before is not None and difference(before[:, :PANEL], now[:, :PANEL]) == 0:
                    return
                before = now

        dark = window.appears(night=True)
        panel_end("the panel ends")
        hands.press(ADD_A_CITY)
        lit = window.wait(lambda image: np.median(sky(image)) > np.median(sky(dark)) + 2, "a city is added",
                          3 * PATIENCE)  # a second or two of work on an idle machine, without a frame between
        city = saved_city()
        expect(float(city["distance"]) == 30e3 and float(city["radius"]) == 8e3, f"the scene has a city {city}")
        panel_end("the city has widgets")
        hands.drag(LUMINANCE, (LUMINANCE[0] + 65, LUMINANCE[1]))
        window.wait(lambda image: np.median(sky(image)) > np.median(sky(lit)) + 2, "the city is brighter")
        expect(float(saved_city()["luminance"]) > float(city["luminance"]), "dragging the luminance did not raise it")
        hands.press(REMOVE)
        window.wait(lambda image: difference(sky(image), sky(dark)) == 0, "the city is removed")
        expect(saved_city() == {}, "the scene still has a city")
        window.quit()
    finally:
        window.close()


def test_no_window():
    """Without a screen: one sentence that says what to do."""
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    result = subprocess.run([SHOWMYSKY, MODEL], env=environment, capture_output=True, text=True, timeout=PATIENCE)
    expect(result.returncode == 1, f"without a screen the exit code is {result.returncode}")
    expect("No window" in result.stderr and "`showmysky render MODEL -o sky.png`" in result.stderr,
           "without a screen it says: " + result.stderr)


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    os.environ.update(XDG_CONFIG_HOME=os.path.abspath("config"), XDG_CACHE_HOME=os.path.abspath("cache"),
                      LIBGL_ALWAYS_SOFTWARE="1", PATH=os.path.dirname(CALCMYSKY) + ":" + os.environ["PATH"])
    os.symlink(MODEL, "model")  # a name that takes one line of the panel, wherever the tree is
    test_no_window()
    screen = Screen(os.path.abspath("screen"))
    try:
        test_scene(screen)
        test_description(screen)
        test_cities(screen)
    finally:
        screen.close()


try:
    main()
except Failure as failure:
    print(f"FAILED: {failure}. Screenshots: {SCRATCH}")
    sys.exit(1)
print("The window does what it should.")
