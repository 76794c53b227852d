"""vfit-room (samples/04_fitting_room), drawing into memory: its pictures, keys, clicks, and messages when
something is missing.

    room_test.py VFIT_ROOM
"""

import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

ROOM = sys.argv.pop(1)
GARMENTS = pathlib.Path(ROOM).parent.parent / "lib/vfit_data/garments"
SUNDRESS = GARMENTS / "sundress.json"
SKIPPED = 77  # as the test's SKIP_RETURN_CODE
SMALL = ["--offscreen", "--film", "--resolution", "640x360", "--samples", "0"]
LARGE = ["--offscreen", "--film", "--resolution", "1280x720", "--samples", "0"]
LEGEND = (510, 630), (60, 110)  # columns and lines of a small picture: below the pictures a second


def run(*arguments, code=0, cwd=None):
    command = [ROOM, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=240, cwd=cwd)
    assert done.returncode == code, f"exit {done.returncode}: {done.stderr}"
    return done


def report(*arguments):
    return json.loads(run("--json", *arguments).stdout)


def read_png(path):
    """Width, height and rows of (r, g, b) bytes of an 8-bit RGB file."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        chunk = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colors = struct.unpack(">IIBB", chunk[:10])
            assert (depth, colors) == (8, 2)
        packed += chunk if kind == b"IDAT" else b""
        at += 12 + length
    raw, pitch = zlib.decompress(packed), 3 * width
    rows, above = [], bytes(pitch)
    for y in range(height):
        kind, line = raw[y * (pitch + 1)], bytearray(raw[y * (pitch + 1) + 1 : (y + 1) * (pitch + 1)])
        for i in range(pitch):
            left, up, corner = line[i - 3] if i >= 3 else 0, above[i], above[i - 3] if i >= 3 else 0
            if kind == 4:
                guess = left + up - corner
                near = min((left, up, corner), key=lambda v: abs(guess - v))
            else:
                near = (0, left, up, (left + up) // 2)[kind]
            line[i] = (line[i] + near) & 255
        rows.append(bytes(line))
        above = rows[-1]
    return width, height, rows


def share(rows, columns, lines, wanted):
    """Of the pixels of that part of the picture, those of which wanted(r, g, b) holds."""
    pixels = [
        (row[3 * x], row[3 * x + 1], row[3 * x + 2])
        for row in rows[lines[0] : lines[1]]
        for x in range(*columns)
    ]
    return sum(wanted(*p) for p in pixels) / len(pixels)


def is_red(r, g, b):  # the first garment's cloth, and the overlay's accent
    return r > 90 and g < 0.6 * r and b < 0.6 * r


def is_dark(r, g, b):  # letters, and the paper of the guidance
    return max(r, g, b) < 110


def centre(rows, columns, lines, wanted):
    """Of the topmost block of lines in which wanted(r, g, b) holds of some pixels: its middle, in pixels."""
    found = {}
    for y in range(*lines):
        xs = [x for x in range(*columns) if wanted(*rows[y][3 * x : 3 * x + 3])]
        if xs:
            found[y] = xs
        elif found:
            break
    assert found, f"no such pixel in columns {columns}, lines {lines}"
    xs = [x for line in found.values() for x in line]
    return (min(xs) + max(xs)) // 2, (min(found) + max(found)) // 2


class Pictures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_a_person_in_a_dress_is_in_the_middle_of_the_picture(self):
        picture = self.folder / "room.png"
        told = report(*SMALL, "--frames", 5, "--garment", "sundress", "--picture", picture)
        self.assertEqual((told["frames"], told["garment"], told["message"]), (5, "sundress", ""))
        self.assertGreater(told["person"]["stature_m"], 1.4)
        self.assertEqual(told["size"], told["person"]["size"])
        self.assertGreater(told["cloth_steps"], 0)
        self.assertIn("fps", told)
        for stage in ("sensor_track", "motion_skin", "cloth", "draw", "frame"):
            self.assertLessEqual(told["stage_ms"][stage]["median"], told["stage_ms"][stage]["p95"])
        width, height, rows = read_png(picture)
        self.assertEqual((width, height), (640, 360))
        middle = (width // 2 - 60, width // 2 + 60), (60, 340)
        self.assertGreater(share(rows, *middle, is_red), 0.15, "the dress")
        is_skin = lambda r, g, b: r > 120 and 1.15 * b < r < 1.8 * b and g < r  # noqa: E731
        self.assertGreater(share(rows, *middle, is_skin), 0.08, "the person")
        is_studio = lambda r, g, b: min(r, g, b) > 150 and max(r, g, b) - min(r, g, b) < 12  # noqa: E731
        self.assertGreater(share(rows, (180, 220), (100, 260), is_studio), 0.95, "nothing beside")
        self.assertGreater(share(rows, (10, 130), (10, 60), is_dark), 0.01, "what is written")
        self.assertLess(share(rows, (200, 440), (5, 40), is_dark), 0.01, "no guidance")
        self.assertEqual(share(rows, *LEGEND, is_red), 0, "no legend")

    def test_the_fit_map_colours_the_cloth_anew(self):
        picture = self.folder / "map.png"
        told = report(*SMALL, "--frames", 4, "--garment", "sundress", "--keys", "1:f", "--picture", picture)
        self.assertTrue(told["fit_map"])
        width, _, rows = read_png(picture)
        self.assertLess(share(rows, (width // 2 - 60, width // 2 + 60), (60, 340), is_red), 0.05)
        is_blue = lambda r, g, b: b > 180 and b > 1.3 * r  # noqa: E731
        for color in (is_red, is_blue):
            self.assertGreater(share(rows, *LEGEND, color), 0.01, "both ends of the legend")

    def test_a_film_has_a_picture_for_each_camera_image(self):
        told = report(*SMALL, "--frames", 3, "--record", self.folder / "film")
        pictures = sorted((self.folder / "film").glob("*.png"))
        self.assertEqual(len(pictures), told["camera_images"])
        self.assertGreater(len(pictures), 30, "the scan is in it")
        width, _, first = read_png(pictures[15])
        last = read_png(pictures[-1])[2]
        guidance = (width // 2 - 120, width // 2 + 120), (14, 62)
        self.assertGreater(share(first, *guidance, is_dark), 0.4)
        self.assertGreater(share(first, *guidance, is_red), 0.02, "how much of the scan is done")
        self.assertLess(share(last, *guidance, is_dark), 0.01)
        self.assertAlmostEqual(told["cloth_ms"]["interval"]["median"], 1000 / 30, delta=0.1)

    def test_nothing_but_the_picture_is_written(self):
        run(*SMALL, "--frames", 3, "--picture", "room.png", cwd=self.folder)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["room.png"])


class Keys(unittest.TestCase):
    def test_sizes_and_garments_go_round(self):
        up = report(*SMALL, "--frames", 6, "--garment", "sundress", "--size", "M", "--keys", "1:up,3:up")
        self.assertEqual(up["size"], "XL")
        self.assertEqual(up["keys"], ["up", "up"])
        down = report(
            *SMALL, "--frames", 4, "--garment", "martial_jacket", "--size", "XS", "--keys", "1:down"
        )
        self.assertEqual(down["size"], "made to measure")
        with tempfile.TemporaryDirectory() as folder:
            other, picture = pathlib.Path(folder) / "other.json", pathlib.Path(folder) / "other.png"
            shutil.copy(SUNDRESS, other)
            two = ["--garment", "sundress", "--garment", other]
            self.assertEqual(
                report(*SMALL, "--frames", 4, *two, "--keys", "1:right,2:left")["garment"], "sundress"
            )
            self.assertEqual(
                report(*SMALL, "--frames", 4, *two, "--keys", "1:left", "--picture", picture)["garment"],
                "other",
            )
            width, _, rows = read_png(picture)
            self.assertLess(
                share(rows, (width // 2 - 60, width // 2 + 60), (60, 340), is_red),
                0.05,
                "it has a colour of its own",
            )

    def test_cloth_camera_and_mirror_are_switched(self):
        off = report(*SMALL, "--frames", 8, "--keys", "1:p,2:m,3:h,4:space,5:c")
        self.assertEqual((off["physics"], off["mirror"], off["camera"]), (False, False, False))
        self.assertLess(off["cloth_steps"], 4)
        self.assertIn("camera is off", off["message"])
        on = report(*SMALL, "--frames", 8, "--keys", "1:p,2:c,4:p,5:c")
        self.assertEqual((on["physics"], on["camera"], on["message"]), (True, True, ""))
        self.assertEqual(report(*SMALL, "--frames", 50, "--keys", "2:esc")["frames"], 2)

    def test_the_cloth_has_a_clock_of_its_own(self):
        # Without drawing, pictures come far more often than every 8 ms.
        told = report("--no-draw", "--seconds", "1", "--min-interval", "8")
        self.assertGreaterEqual(told["cloth_ms"]["interval"]["median"], 8.0)
        self.assertIsNone(told["renderer"])
        self.assertNotIn("draw", told["stage_ms"])


class Clicks(unittest.TestCase):
    """Widgets are found in a picture by their color, then clicked by their place."""

    LIST, BOXES = (20, 260), (28, 50)  # columns of the panel, and of its check boxes

    def picture(self, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "room.png"
            run(*LARGE, "--frames", 3, "--picture", path, *arguments)
            return read_png(path)[2]

    def test_a_garment_is_chosen_in_the_list(self):
        garments = sorted(p.stem for p in GARMENTS.glob("*.json"))
        is_chosen = lambda r, g, b: r > 210 and 15 < r - g < 60 and 15 < r - b < 60  # noqa: E731
        x, first = centre(self.picture(), self.LIST, (100, 600), is_chosen)
        x, third = centre(self.picture("--keys", "1:right,2:right"), self.LIST, (100, 600), is_chosen)
        self.assertGreater(third - first, 30, "two lines below")
        told = report(*LARGE, "--frames", 8, "--clicks", f"2:{x}x{third}")
        self.assertEqual(told["garment"], garments[2])
        beside = report(*LARGE, "--frames", 8, "--clicks", f"2:400x{third}")
        self.assertEqual(beside["garment"], garments[0])

    def test_sizes_and_switches_are_buttons(self):
        dress = ["--garment", "sundress"]
        recommended = report(*SMALL, "--frames", 1, *dress)["size"]
        rows = self.picture(*dress)
        x, y = centre(rows, self.LIST, (230, 600), is_red)
        told = report(*LARGE, "--frames", 8, *dress, "--size", "XXL", "--clicks", f"2:{x}x{y}")
        self.assertEqual((told["size"], told["keys"]), (recommended, []))
        x, y = centre(rows, self.BOXES, (y + 20, 700), is_red)
        told = report(*LARGE, "--frames", 8, *dress, "--clicks", f"2:{x}x{y}")
        self.assertEqual((told["physics"], told["keys"]), (False, ["p"]))

    def test_a_small_window_has_menus(self):
        told = report(*SMALL, "--frames", 12, "--clicks", "2:60x93,7:60x150")
        self.assertNotEqual(told["garment"], report(*SMALL, "--frames", 1)["garment"])


class Trouble(unittest.TestCase):
    def say(self, *arguments, code=1):
        said = run(*arguments, code=code).stderr.strip().splitlines()[-1]
        self.assertTrue(said.startswith("vfit-room: "), said)
        return said

    def test_one_sentence_says_what_is_wrong(self):
        self.assertIn("no display", self.say("--frames", 1))
        self.assertIn("no_such", self.say(*SMALL, "--garment", "no_such"))
        self.assertIn("3XL", self.say(*SMALL, "--garment", "sundress", "--size", "3XL"))
        self.assertIn("nowhere", self.say("/nowhere", *SMALL))
        self.assertIn("--nonsense", self.say("--nonsense", code=2))
        self.assertIn("'5' is not FRAME:XxY", self.say("--clicks", "5", code=2))
        self.assertIn("'7' is not XxY", self.say("--clicks", "5:7", code=2))
        with tempfile.TemporaryDirectory() as empty:
            self.assertIn("no garment", self.say(*SMALL, "--data", empty))

    def test_a_source_that_ends_is_waited_for(self):
        told = report(
            "virtual:motion=demo&sex=f&seed=7&frames=60",
            "--offscreen",
            "--resolution",
            "640x360",
            "--samples",
            "0",
            "--seconds",
            "4",
        )
        self.assertGreater(told["frames"], 10)
        self.assertGreater(told["camera_images"], 60, "it was opened again")

    def test_a_film_ends_with_its_source(self):
        told = report("virtual:motion=demo&sex=f&seed=7&frames=60", *SMALL)
        self.assertEqual(told["camera_images"], 60)
        self.assertIn("ended before", self.say("virtual:people=0&frames=10", *SMALL))


if __name__ == "__main__":
    look = subprocess.run([ROOM, "--offscreen", "--renderer"], capture_output=True, text=True, timeout=60)
    if look.returncode != 0 and "EGL" in look.stderr:
        print("SKIPPED: fitting_room needs EGL that draws in software:", look.stderr.strip())
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
