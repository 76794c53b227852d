#!/usr/bin/env python3
"""The command-line contract: keys, units, exit codes and one clear line for every failure.

    cli_test.py VFIT [SHARED [CLASS ...]]

SHARED is the folder of real data (VFIT_SHARED overrules it); tests that need it are skipped by name where it
is absent. CLASS: only these tests. VFIT_TEST_REPORTS: a folder in which a report tells which tests passed,
failed and were skipped.
"""

import json
import math
import os
import pathlib
import shutil
import signal
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

try:
    import pty
except ImportError:  # Windows
    pty = None

VFIT = sys.argv[1]
SHARED = pathlib.Path(os.environ.get("VFIT_SHARED", sys.argv[2] if len(sys.argv) > 2 else "/nonexistent"))
RECORDINGS = sorted(p for p in (SHARED / "data" / "recordings").glob("*") if p.is_dir())
VIRTUAL = "virtual:motion=demo&sex=f&sensor=kinect_v1_320&seed=3&frames=60"
GARMENTS = pathlib.Path(VFIT).parents[1] / "lib" / "vfit_data" / "garments"
PAPER_JOINTS = 15


def run_program(program, *args):
    return subprocess.run(
        [program, *map(str, args)], capture_output=True, text=True, errors="replace", timeout=300
    )


def run(*args):
    return run_program(VFIT, *args)


def document(test, *args):
    done = run(*args)
    test.assertEqual(done.returncode, 0, done.stderr)
    return json.loads(done.stdout)


def lines(test, *args):
    done = run(*args)
    test.assertEqual(done.returncode, 0, done.stderr)
    return [json.loads(line) for line in done.stdout.splitlines()]


def picture(path):
    """Width, height and RGB bytes of a PNG file as the tools write it: eight bits, not interlaced."""
    data, parts, at = path.read_bytes(), b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert (depth, colour) == (8, 2), path
        elif kind == b"IDAT":
            parts += body
        at += 12 + length
    raw, row, out = zlib.decompress(parts), 3 * width, bytearray()
    before = bytearray(row)
    for y in range(height):
        kind, line = raw[y * (row + 1)], bytearray(raw[y * (row + 1) + 1 : (y + 1) * (row + 1)])
        for i in range(row):
            a, b, c = line[i - 3] if i > 2 else 0, before[i], before[i - 3] if i > 2 else 0
            paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            line[i] = (line[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        out += line
        before = line
    return width, height, bytes(out)


def numbers(value):
    if value is None:
        yield math.nan  # as JSON spells what is no number
    elif isinstance(value, dict):
        for v in value.values():
            yield from numbers(v)
    elif isinstance(value, list):
        for v in value:
            yield from numbers(v)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield value


def osc_messages(packet):
    """Address -> arguments, or a list of them for bones, of a bundle of Open Sound Control 1.0."""

    def text(at):
        end = packet.index(b"\0", at)
        return packet[at:end].decode(), at + (end - at) // 4 * 4 + 4

    assert packet[:16] == b"#bundle\0" + struct.pack(">Q", 1)
    messages, at = {}, 16
    while at < len(packet):
        (size,) = struct.unpack_from(">I", packet, at)
        end = at + 4 + size
        address, at = text(at + 4)
        types, at = text(at)
        values = []
        for kind in types[1:]:
            if kind == "s":
                value, at = text(at)
            else:
                (value,) = struct.unpack_from(">" + kind, packet, at)
                at += 4
            values.append(value)
        assert at == end, address
        if address.endswith("/Bone/Pos"):
            messages.setdefault(address, {})[values[0]] = values[1:]
        else:
            messages[address] = values
    return messages


class UdpReceiver:
    """Keeps what a program sends to a port of this machine, with the time at which it came."""

    def __enter__(self):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        self.address = f"127.0.0.1:{self.socket.getsockname()[1]}"
        return self

    def __exit__(self, *_):
        self.socket.close()

    def packets(self, count):
        self.socket.settimeout(10)
        return [osc_messages(self.socket.recv(65536)) for _ in range(count)]


def bvh_file(path):
    """Frame time, names of the joints in order, channel values of each frame."""
    head, motion = path.read_text().split("MOTION\n")
    names = [line.split()[1] for line in head.splitlines() if "JOINT" in line or "ROOT" in line]
    first, second, *rows = motion.splitlines()
    frames = [[float(v) for v in row.split()] for row in rows]
    assert first == f"Frames: {len(frames)}"
    assert all(len(row) == 3 + 3 * len(names) for row in frames)
    return float(second.removeprefix("Frame Time: ")), names, frames


def joint_table(rows, unit=1.0):
    """vfit's own table of [{joint: (x, y, z)}, ...] at 30 Hz."""
    joints = list(rows[0])
    head = ["time_s", *(f"{j}_{axis}" for j in joints for axis in "xyz")]
    lines = [",".join(head)]
    for i, row in enumerate(rows):
        lines.append(",".join(str(v) for v in (i / 30, *(unit * x for j in joints for x in row[j]))))
    return "\n".join(lines) + "\n"


def swaying(count):
    """A person who stands before the camera and sways to their left."""
    places = {
        "HEAD": (0, 1.6), "NECK": (0, 1.42), "TORSO": (0, 1.15),
        "LEFT_SHOULDER": (0.18, 1.38), "RIGHT_SHOULDER": (-0.18, 1.38),
        "LEFT_ELBOW": (0.22, 1.1), "RIGHT_ELBOW": (-0.22, 1.1),
        "LEFT_HAND": (0.24, 0.85), "RIGHT_HAND": (-0.24, 0.85),
        "LEFT_HIP": (0.09, 0.9), "RIGHT_HIP": (-0.09, 0.9),
        "LEFT_KNEE": (0.1, 0.5), "RIGHT_KNEE": (-0.1, 0.5),
        "LEFT_FOOT": (0.1, 0.08), "RIGHT_FOOT": (-0.1, 0.08),
    }  # fmt: skip
    # The feet stay.
    share = {"LEFT_FOOT": 0, "RIGHT_FOOT": 0, "LEFT_KNEE": 0.5, "RIGHT_KNEE": 0.5}
    return [
        {j: (x + 0.003 * i * share.get(j, 1), y, -2.0) for j, (x, y) in places.items()} for i in range(count)
    ]


class Contract(unittest.TestCase):
    def check_failure(self, done, *words):
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_info_names_version_simd_and_plug_ins(self):
        info = document(self, "info", "--json")
        self.assertRegex(info["version"], r"^\d+\.\d+\.\d+$")
        self.assertTrue(info["simd"])
        self.assertEqual(
            {p["name"] for p in info["plugins"]} & {"recording", "virtual_person"},
            {"recording", "virtual_person"},
        )

    def test_the_paper_as_printed_is_another_estimate(self):
        stature = {}
        for method in ("paper", "paper-as-printed"):
            result = document(self, "measure", VIRTUAL, "--method", method, "--json")
            self.assertEqual(result["method"], method)
            stature[method] = result["measurements"]["stature_m"]["value"]
        self.assertGreater(abs(stature["paper"] - stature["paper-as-printed"]), 0.01)

    def test_cameras_that_stand_around_measure_together(self):
        views = [VIRTUAL.replace("demo", "scan") + f"&facing={way}" for way in (0, 90, 180, 270)]
        walks = [view.replace("scan", "walk") for view in views]
        with tempfile.TemporaryDirectory() as folder:
            places = os.path.join(folder, "places.json")
            found = document(self, "cameras", *walks, "--out", places, "--frames", "60", "--json")
            for camera, turned in zip(found["cameras"], (0, -90, 180, 90)):
                off = (camera["turned_deg"] - turned + 180) % 360 - 180
                self.assertLess(abs(off), 1.0, found)
            self.assertTrue(all(pair["rms_m"] < 0.03 for pair in found["of"]), found)
            others = [word for view in views[1:] for word in ("--camera", view)]
            given = ["--places", places, "--tight", "--bare", "--frames", "5", "--json"]
            around = document(self, "measure", views[0], *others, *given)
            self.assertAlmostEqual(around["turned"], 4 / 24)
            alone = document(self, "measure", views[0], "--tight", "--bare", "--frames", "5", "--json")
            sigma = [run["measurements"]["hip_girth_m"]["sigma"] for run in (around, alone)]
            self.assertLess(sigma[0], sigma[1])
            self.check_failure(run("measure", views[0], "--camera", views[1], *given), "4 cameras, not 2")
            # The person comes in, and leaves again while they are still the active one.
            visit = VIRTUAL.replace("demo", "visit").replace("frames=60", "rate=10&frames=210")
            met = document(self, "cameras", visit, visit, "--out", places, "--json")
            self.assertLess(met["of"][0]["rms_m"], 0.001)
            given_visit = ["--camera", visit, "--places", places, "--frames", "5", "--json"]
            self.assertEqual(run("measure", visit, *given_visit).returncode, 0)
            standing = run("cameras", *views[:2], "--frames", "20")
            self.check_failure(standing, "walk about", "facing=90")
            with open(places, "w") as file:
                file.write('{"format": "vfit-cameras", "version": 1, "cameras": [{"turned_deg": 1}]}')
            self.check_failure(run("measure", views[0], *others, *given), places, "position")
        self.assertEqual(run("cameras", views[0]).returncode, 2)
        self.assertEqual(run("measure", views[0], "--turn", "--camera", views[1]).returncode, 2)
        self.assertEqual(run("measure", views[0], "--places", "x").returncode, 2)

    def test_a_turn_that_did_not_happen_is_told(self):
        standing = VIRTUAL.replace("demo", "scan")
        asked = document(self, "measure", standing, "--turn", "--frames", "5", "--json")
        self.assertIn("no whole turn", asked["note"])
        self.assertLess(asked["turned"], 0.5)
        self.assertNotIn("note", document(self, "measure", standing, "--side-frames", "0", "--json"))

    def test_the_fitted_body_measures_girths_with_intervals(self):
        result = document(
            self,
            "measure",
            VIRTUAL.replace("demo", "scan"),
            "--method",
            "fit",
            "--frames",
            "12",
            "--side-frames",
            "0",
            "--json",
        )
        self.assertEqual((result["method"], result["frames"], result["side_frames"]), ("fit", 12, 0))
        measured = result["measurements"]
        paper = document(self, "measure", VIRTUAL.replace("demo", "scan"), "--method", "paper", "--json")[
            "measurements"
        ]
        self.assertAlmostEqual(measured["stature_m"]["value"], paper["stature_m"]["value"], delta=0.03)
        self.assertTrue(measured["stature_m"]["observed"])
        self.assertFalse(measured["chest_girth_m"]["observed"])  # from the front alone
        for key in ("chest_girth_m", "waist_girth_m", "hip_girth_m", "inside_leg_m", "arm_length_m"):
            self.assertTrue(0.002 < measured[key]["sigma"] < 0.1, key)

    def test_measure_prints_the_contract(self):
        result = document(
            self, "measure", VIRTUAL, "--method", "paper", "--garment", "short_sleeves", "--json"
        )
        self.assertEqual(result["method"], "paper")
        self.assertEqual(result["frames"], 30)
        for key in ("stature_m", "shoulder_breadth_m"):
            self.assertEqual(set(result["measurements"][key]), {"value", "sigma", "observed"})
        self.assertTrue(1.5 < result["measurements"]["stature_m"]["value"] < 1.75)
        self.assertEqual(len(result["colliders"]), PAPER_JOINTS)
        self.assertEqual(set(result["colliders"][0]), {"joint", "radius_m"})
        self.assertEqual(set(result["scale"]), {"x", "y"})
        self.assertGreater(result["compute_ms"]["total"], 0)
        self.assertTrue(all(math.isfinite(x) for x in numbers(result)))

    def test_a_map_of_the_trackers_own_goes_with_recorded_joints(self):
        told = document(self, "measure", VIRTUAL, "--json")["measurements"]["stature_m"]["value"]
        found = document(self, "measure", VIRTUAL, "--joints", "recorded", "--user-map", "tracked", "--json")
        self.assertNotEqual(found["measurements"]["stature_m"]["value"], told)
        self.assertAlmostEqual(found["measurements"]["stature_m"]["value"], told, delta=0.03)
        self.assertEqual(found["frames"], 30)

    def test_measures_feed_size(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "measures.json"
            path.write_text(run("measure", VIRTUAL, "--json").stdout)
            result = document(self, "size", path, "--chart", "paper", "--garment", "short_sleeves", "--json")
            self.assertEqual((result["chart"], result["garment"]), ("paper", "short_sleeves"))
            p = [s["probability"] for s in result["sizes"]]
            self.assertAlmostEqual(sum(p), 1, places=4)
            self.assertEqual(p, sorted(p, reverse=True))
            path.write_text('{"chest_girth_m": 0.98}')
            result = document(
                self, "size", path, "--chart", "en13402_men", "--garment", "short_sleeves", "--json"
            )
            self.assertEqual(result["sizes"][0]["label"], "M")

    def test_a_size_is_told_by_zone_and_between_two(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "measures.json"
            path.write_text('{"chest_girth_m": {"value": 0.94, "sigma": 0.02}}')
            args = ("size", path, "--chart", "en13402_men", "--garment", "short_sleeves")
            result = document(self, *args, "--size", "M", "--json")
            self.assertEqual(set(result["between"]), {"S", "M"})
            self.assertAlmostEqual(result["zones"]["chest_girth_m"]["ease"], 0.04, places=5)
            self.assertIn("between", run(*args).stdout)
            self.assertIn("loose", run(*args, "--size", "L").stdout)
            self.check_failure(run(*args, "--size", "Q"), "XXL")
            path.write_text('{"waist_girth_m": 0.85, "inside_leg_m": 0.81}')
            result = document(self, "size", path, "--chart", "jeans_men", "--garment", "trousers", "--json")
            self.assertEqual(result["sizes"][0]["label"], "W33/L32")
            path.write_text('{"stature_m": 1.75, "body_mass_kg": 71}')
            result = document(
                self, "size", path, "--chart", "height_weight_men", "--garment", "short_sleeves", "--json"
            )
            self.assertEqual(result["sizes"][0]["label"], "M")

    def test_one_size_and_long_labels_are_printed_in_columns(self):
        with tempfile.TemporaryDirectory() as folder:
            measures, chart = pathlib.Path(folder) / "m.json", pathlib.Path(folder) / "chart.json"
            measures.write_text('{"waist_girth_m": {"value": 0.8, "sigma": 0.02}, "stature_m": 1.9}')
            head = {"format": "vfit-size-chart", "version": 1, "name": "x", "unit": "cm"}
            steps = [("W32/L34 long", [76, 80]), ("W33/L34 \u00fcberlang, weit", [80, 84]), ("W34", [84, 88])]
            sizes = [{"label": label, "ranges": {"waist_girth_m": r}} for label, r in steps]
            one = {"label": "one size", "ranges": {"stature_m": [None, 185]}}
            garments = [
                {"kind": "jeans", "measures": ["waist_girth_m"], "sizes": sizes},
                {"kind": "cape", "measures": ["stature_m"], "sizes": [one]},
                {"kind": "cap", "sizes": [{"label": "one size"}]},
            ]
            chart.write_text(json.dumps({**head, "garments": garments}))
            told = run("size", measures, "--chart", chart, "--garment", "jeans").stdout.splitlines()
            table = [line for line in told if line.endswith(" %")]
            self.assertEqual(len(table), 3, told)
            self.assertEqual(len({len(line) for line in table}), 1, "the percentages stand in one column")
            for line in table:
                self.assertRegex(line, r"\S  +\d+\.\d %$")
            for garment, outside in (("cape", {"stature_m": "above"}), ("cap", None)):
                args = ("size", measures, "--chart", chart, "--garment", garment)
                result = document(self, *args, "--json")
                self.assertEqual(result["sizes"], [{"label": "one size", "probability": 1.0}])
                self.assertEqual(result.get("outside"), outside)
                self.assertEqual("above the range of one size" in run(*args).stdout, garment == "cape")

    def test_a_body_beyond_the_chart_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "measures.json"
            args = ("size", path, "--chart", "en13402_men", "--garment", "short_sleeves")
            path.write_text('{"chest_girth_m": 1.6}')
            result = document(self, *args, "--json")
            self.assertEqual(result["outside"], {"chest_girth_m": "above"})
            self.assertIn("chest_girth_m is above the range of 3XL", run(*args).stdout)
            path.write_text('{"chest_girth_m": 0.98}')
            self.assertEqual(set(document(self, *args, "--json")), {"chart", "garment", "sizes"})

    def test_centimetres_under_a_metre_key_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "cm.json"
            path.write_text('{"stature_m": 172, "chest_girth_m": 95}')
            args = ("size", path, "--chart", "en13402_men", "--garment", "short_sleeves")
            self.check_failure(run(*args), "chest_girth_m", "95", "0.14 to 3.7 m", "centimetres")
            path.write_text('{"stature_m": 0.5, "chest_girth_m": 0.36}')
            self.assertEqual(document(self, *args, "--json")["sizes"][0]["label"], "XXS", "a newborn")
            self.check_failure(run("measure", VIRTUAL, "--merge", self.cm_profile(path)), "stature_m", "172")

    @staticmethod
    def cm_profile(path):
        path.write_text('{"stature_m": 172}')
        return path

    @unittest.skipUnless((SHARED / "data" / "field" / "charts").is_dir(), f"no published charts at {SHARED}")
    def test_published_charts_are_read(self):
        charts = SHARED / "data" / "field" / "charts"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "measures.json"

            def best(chart, **inches):
                path.write_text(json.dumps({key: 0.0254 * value for key, value in inches.items()}))
                result = document(self, "size", path, "--chart", charts / chart, "--garment", "x", "--json")
                self.assertAlmostEqual(sum(s["probability"] for s in result["sizes"]), 1, places=4)
                return result["sizes"][0]["label"]

            trousers = {"waist_girth_m": 36, "hip_girth_m": 42, "inside_leg_m": 32}
            self.assertEqual(best("mens-bottoms.json", **trousers), "L")
            self.assertEqual(best("mens-bottoms.json", inside_leg_m=31.2), "XS")
            child = {"chest_girth_m": 20.9, "waist_girth_m": 20.9}
            self.assertEqual(best("toddler.json", **child, stature_m=34), "2T")
            self.assertEqual(best("toddler.json", **child, stature_m=36), "3T")
            self.check_failure(
                run("size", charts / "cm.json", "--chart", "en13402_men", "--garment", "short_sleeves"),
                "centimetres",
            )

    def test_scans_are_calibrated_to_a_tape(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            scan, tape, shop = path / "scan.json", path / "tape.json", path / "shop.json"
            told = document(self, "measure", VIRTUAL, "--profile", scan, "--json")["measurements"]
            waist = told["waist_girth_m"]["value"]
            for i in range(20):
                tape.write_text(json.dumps({"waist_girth_m": waist + 0.03 + 0.001 * (i % 3)}))
                state = document(self, "calibrate", shop, "--scan", scan, "--tape", tape, "--json")
            self.assertEqual(set(state), {"waist_girth_m"})
            self.assertEqual((state["waist_girth_m"]["people"], state["waist_girth_m"]["enough"]), (20, True))
            self.assertAlmostEqual(state["waist_girth_m"]["offset"], 0.031, places=4)
            self.assertIn("20 people", run("calibrate", shop).stdout)
            again = document(self, "measure", VIRTUAL, "--calibration", shop, "--json")["measurements"]
            self.assertAlmostEqual(again["waist_girth_m"]["value"], waist + 0.031, places=3)
            self.assertLess(again["waist_girth_m"]["sigma"], told["waist_girth_m"]["sigma"])
            self.assertEqual(again["stature_m"], told["stature_m"])
            self.check_failure(run("calibrate", path / "gone.json"), "gone.json")
            self.check_failure(run("calibrate", shop, "--scan", scan), "--tape")
            self.check_failure(run("measure", VIRTUAL, "--calibration", scan), "calibration", "format")

    def test_scans_are_validated_by_a_tape(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            profile = path / "anna.json"
            told = document(self, "measure", VIRTUAL, "--profile", profile, "--json")["measurements"]
            waist_cm = 100 * told["waist_girth_m"]["value"]
            table = path / "tapes.csv"
            table.write_text(
                "scan,person,sex,waist_girth_cm,stature_m\n"
                f"anna.json,anna,f,{waist_cm - 2},1.6\nanna.json,bea,f,{waist_cm - 1},\n"
                f"anna.json,bea,f,{waist_cm - 1},\nlost.json,cleo,f,80,1.7\n"
            )
            result = document(self, "validate", folder, "--picture", path / "agreement.png", "--json")
            self.assertEqual((result["scans"], len(result["failed"])), (4, 1))
            self.assertIn("lost.json", result["failed"][0]["reason"])
            waist = result["measures"]["waist_girth_m"]
            self.assertEqual((waist["people"], waist["scans"], waist["iso_20685"]), (2, 3, "open"))
            self.assertAlmostEqual(waist["bias"], 0.015, places=5)
            self.assertEqual(result["measures"]["stature_m"]["people"], 1)
            self.assertGreater((path / "agreement.png").stat().st_size, 2000)
            self.assertIn("waist_girth_m", run("validate", table).stdout)
            # A recording that holds its person's measures needs no table.
            recording = path / "recordings" / "anna"
            run("record", VIRTUAL, recording)
            result = document(self, "validate", recording.parent, "--side-frames", 0, "--json")
            self.assertEqual(result["failed"], [])
            self.assertLess(abs(result["measures"]["stature_m"]["bias"]), 0.03)
            for text, word in (
                ("scan,girth\n", "girth"),
                ("person,waist_girth_m\n", '"scan"'),
                ("scan,waist_girth_m\nanna.json,wide\n", "no number"),
                ("scan,sex\nanna.json,x\n", "neither f nor m"),
            ):
                table.write_text(text)
                self.check_failure(run("validate", table), word, "tapes.csv")
            self.check_failure(run("validate", path / "none"), "cannot be read")

    def test_all_measures_are_estimated_from_a_few(self):
        known = ("estimate", "height=5ft8in", "weight=150lb", "--sex", "f", "--age", "34")
        with tempfile.TemporaryDirectory() as folder:
            profile = pathlib.Path(folder) / "me.json"
            result = document(self, *known, "--profile", profile, "--json")
            told = result["measurements"]
            self.assertAlmostEqual(told["stature_m"]["value"], 1.727, places=2)
            self.assertTrue(told["stature_m"]["observed"] and not told["hip_girth_m"]["observed"])
            self.assertEqual(result["doubts"], [])
            more = document(self, *known, "waist=29in+-1cm", "--json")["measurements"]
            self.assertLess(more["hip_girth_m"]["sigma"], told["hip_girth_m"]["sigma"])
            # vfit size takes the profile.
            chart = ("--chart", "en13402_women", "--garment", "dress")
            sizes = document(self, "size", profile, *chart, "--json")
            self.assertAlmostEqual(sum(s["probability"] for s in sizes["sizes"]), 1.0, places=3)
            doubts = document(self, *known, "waist=29cm", "hip=38in", "--json")["doubts"]
            self.assertEqual([(d["key"], d["kind"]) for d in doubts], [("waist_girth_m", "inches")])
            self.assertIn("in inches, 73.7 cm?", run(*known, "waist=29cm", "hip=38in").stdout)
        for arguments, word in (
            (("height=172",), "stature_m"),
            (("height=172cm", "--age", "7"), "age"),
            (("height=172cm", "--population", "martians"), "martians"),
            (("height=172cm", "stature=171cm"), "twice"),
        ):
            self.check_failure(run("estimate", *arguments), word)
        for arguments, word in (
            (("nose=5cm",), "nose"),
            (("height=5ft8",), "without a unit"),
            (("height=172kg",), "unit"),
            (("height=",), "height"),
            (("height",), "MEASURE=AMOUNT"),
            ((), "no measure"),
        ):
            done = run("estimate", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(word, done.stderr)

    def test_a_profile_is_kept_and_merged(self):
        with tempfile.TemporaryDirectory() as folder:
            first, both = pathlib.Path(folder) / "first.json", pathlib.Path(folder) / "both.json"
            told = document(self, "measure", VIRTUAL, "--sex", "m", "--profile", first, "--json")[
                "measurements"
            ]
            profile = json.loads(first.read_text())
            self.assertEqual((profile["format"], profile["sex"]), ("vfit-profile", "m"))
            self.assertEqual(profile["measurements"], told)
            run("measure", VIRTUAL.replace("seed=3", "seed=9"), "--merge", first, "--profile", both)
            merged = json.loads(both.read_text())["measurements"]
            self.assertEqual(set(merged), set(told))
            self.assertLess(abs(merged["stature_m"]["value"] - told["stature_m"]["value"]), 0.02)
            self.check_failure(
                run("measure", VIRTUAL + "&height=0.1", "--merge", first), "two people", "stature_m"
            )
            self.check_failure(
                run("measure", VIRTUAL, "--merge", pathlib.Path(folder) / "gone.json"), "gone.json"
            )

    def test_track_prints_each_frame_in_camera_space_and_writes_the_map(self):
        with tempfile.TemporaryDirectory() as folder:
            frames = lines(self, "track", VIRTUAL, "--user-map-out", folder, "--json")
            self.assertEqual([f["frame"] for f in frames], list(range(60)))
            head = frames[0]["bodies"][0]["joints"]["HEAD"]
            self.assertEqual(len(head), 4)
            self.assertTrue(2.0 < head[2] < 2.8, "z is the distance from the camera")
            self.assertLess(head[1], 0, "y points down and the head is above the camera")
            self.assertEqual(len(list(pathlib.Path(folder).glob("*.png"))), 60)

    def test_track_draws_what_it_saw(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            source = VIRTUAL.replace("frames=60", "frames=3")
            tracked = ("--joints", "tracked", "--user-map", "tracked", "--json")
            lines(
                self,
                "track",
                source,
                "--pictures",
                folder / "told",
                "--user-map-out",
                folder / "maps",
                "--json",
            )
            lines(self, "track", source, "--pictures", folder / "found", *tracked)
            lines(
                self, "track", source + "&distance=6", "--pictures", folder / "empty", *tracked
            )  # out of reach
            files = [
                folder / name / f"00000{index}.png"
                for name in ("told", "found", "empty")
                for index in range(3)
            ]
            self.assertEqual(sorted(files), sorted(folder.glob("[tfe]*/*")))
            self.assertEqual(len({file.read_bytes() for file in files}), 9, "no two are alike")
            shares = []
            for file in files[::3]:
                width, height, pixels = picture(file)
                self.assertEqual(
                    (width, height > 720), (960, True), "three times the image, and a line of text"
                )
                # The first person's colour, which is nowhere in a grey room.
                shares.append(sum(r > b + 60 for r, b in zip(pixels[::3], pixels[2::3])) / (width * height))
            self.assertGreater(min(shares[:2]), 0.02)
            self.assertLess(shares[2], 0.001)
            self.check_failure(
                run("track", source, "--pictures", folder, "--user-map-out", folder), "two folders"
            )

    def test_the_tracker_finds_people_and_joints_by_itself(self):
        given = lines(self, "track", VIRTUAL, "--json")
        for extra in (("--joints", "tracked"), ("--joints", "tracked", "--user-map", "tracked")):
            found = lines(self, "track", VIRTUAL, *extra, "--json")
            self.assertEqual(len(found), len(given))
            errors, ids = [], set()
            for f, g in zip(found, given):
                self.assertEqual(len(f["bodies"]), 1, extra)
                ids.add(f["bodies"][0]["id"])
                joints, truth = f["bodies"][0]["joints"], g["bodies"][0]["joints"]
                errors += [math.dist(joints[n][:3], truth[n][:3]) for n in truth if n in joints]
            self.assertEqual(len(ids), 1)
            self.assertNotEqual(found, given)
            self.assertLess(statistics.median(errors), 0.06, extra)
            self.assertGreater(sum(e < 0.1 for e in errors), 0.8 * len(errors), extra)

    def test_motion_prints_pose_and_contacts(self):
        frames = lines(self, "motion", VIRTUAL, "--json")
        self.assertEqual(len(frames), 60)
        self.assertEqual(set(frames[9]), {"frame", "joints", "bones", "root", "contacts", "ms"})
        self.assertEqual(set(frames[9]["contacts"]), {"left", "right"})
        for q in frames[9]["bones"].values():
            self.assertAlmostEqual(sum(x * x for x in q), 1, places=3)
        self.assertTrue(all(math.isfinite(x) for f in frames for x in numbers(f)))
        raw = lines(self, "motion", VIRTUAL, "--raw", "--json")
        self.assertNotEqual(raw[30]["joints"], frames[30]["joints"])

    def test_joints_without_pictures_move_as_those_of_a_recording(self):
        with tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder) / "joints.csv"
            table.write_text(joint_table(swaying(40)))
            frames = lines(self, "motion", table, "--json")
            self.assertEqual([f["frame"] for f in frames], list(range(40)))
            self.assertEqual(set(frames[9]), {"frame", "joints", "bones", "root", "contacts", "ms"})
            for q in frames[9]["bones"].values():
                self.assertAlmostEqual(sum(x * x for x in q), 1, places=3)
            last = frames[-1]
            for joint, at in swaying(40)[-1].items():  # the world, not a camera's space
                self.assertLess(math.dist(last["joints"][joint][:3], at), 0.05, joint)
            self.assertLess(math.dist(last["root"], (0.117, 0.9, -2.0)), 0.05)
            self.assertEqual(len(lines(self, "motion", table, "--json", "--frames", "7")), 7)

    def test_joints_are_taken_while_they_are_written(self):
        head, *rows = joint_table(swaying(9)).splitlines(keepends=True)
        args = [VFIT, "motion", "-", "--json"]
        with subprocess.Popen(
            args, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as program:
            program.stdin.write(head)
            for i, row in enumerate(rows):
                program.stdin.write(row)
                program.stdin.flush()
                self.assertEqual(json.loads(program.stdout.readline())["frame"], i)
            program.stdin.write("0.4,1,2\n")
            program.stdin.close()
            self.assertRegex(program.stderr.read(), r"standard input, line 11: 3 columns")
        self.assertEqual(program.returncode, 1)
        for text, words in (
            ("", ("standard input", "empty")),
            ("1,2\n", ("standard input, line 1", "'1'", "time_s")),
            (joint_table(swaying(9), unit=1000), ("standard input", "millimetres?")),
        ):
            done = subprocess.run(args, input=text, capture_output=True, text=True, timeout=60)
            self.check_failure(done, *words)

    @unittest.skipUnless((SHARED / "data" / "kinect2_joints").is_dir(), f"no Kinect v2 streams at {SHARED}")
    def test_real_streams_of_a_kinect_v2_are_moved(self):
        for path in sorted((SHARED / "data" / "kinect2_joints").glob("*.csv")):
            rows = path.read_text().splitlines()
            frames = lines(self, "motion", path, "--json")
            self.assertEqual(len(frames), len(rows), path)
            self.assertTrue(all(math.isfinite(x) for f in frames for x in numbers(f)), path)

    def test_poses_are_sent_by_vmc_as_they_are_printed_and_at_their_pace(self):
        with tempfile.TemporaryDirectory() as folder, UdpReceiver() as receiver:
            table = pathlib.Path(folder) / "joints.csv"
            table.write_text(joint_table(swaying(31)))
            start = time.monotonic()
            frames = lines(self, "motion", table, "--json", "--vmc", receiver.address)
            self.assertGreater(time.monotonic() - start, 1.0, "31 poses at 30 Hz take a second")
            for i, (frame, told) in enumerate(zip(frames, receiver.packets(len(frames)))):
                self.assertEqual(told["/VMC/Ext/OK"], [1])
                self.assertAlmostEqual(told["/VMC/Ext/T"][0], i / 30, places=4)
                self.assertEqual(told["/VMC/Ext/Root/Pos"], ["root", 0, 0, 0, 0, 0, 0, 1])
                bones = told["/VMC/Ext/Bone/Pos"]
                self.assertEqual(set(bones), {name[0].upper() + name[1:] for name in frame["bones"]})
                for name, (x, y, z, w) in frame["bones"].items():
                    for got, wanted in zip(bones[name[0].upper() + name[1:]][3:], (x, -y, -z, w)):
                        self.assertAlmostEqual(got, wanted, places=6)
                x, y, z = frame["root"]
                self.assertLess(math.dist(bones["Hips"][:3], (-x, y, z)), 1e-5)

    def test_poses_of_a_sensor_are_sent_to_vrchat(self):
        with UdpReceiver() as receiver:
            source = VIRTUAL.replace("60", "12")
            self.assertEqual(len(lines(self, "motion", source, "--json", "--vrchat", receiver.address)), 12)
            for told in receiver.packets(12):
                names = [*map(str, range(1, 9)), "head"]
                wanted = {
                    f"/tracking/trackers/{n}/{what}" for n in names for what in ("position", "rotation")
                }
                self.assertEqual(set(told), wanted)
                left, right = (told[f"/tracking/trackers/{n}/position"] for n in (3, 4))
                self.assertLess(left[0], right[0], "the left is at -X in Unity")
                self.assertGreater(told["/tracking/trackers/head/position"][1], 1.2)

    def test_a_motion_is_written_as_bvh(self):
        with tempfile.TemporaryDirectory() as folder:
            table, path = pathlib.Path(folder) / "joints.csv", pathlib.Path(folder) / "motion.bvh"
            table.write_text(joint_table(swaying(31)))
            path.write_text("what was there before")
            printed = lines(self, "motion", table, "--json", "--bvh", path)
            step_s, names, frames = bvh_file(path)
            self.assertAlmostEqual(step_s, 1 / 30, places=6)
            self.assertEqual((len(frames), len(names)), (31, 22))
            for row, frame in zip(frames, printed):  # the legs of the last frame, which are 1 cm longer
                self.assertLess(math.dist(row[:3], [100 * v for v in frame["root"]]), 1.5)
            self.assertLess(math.dist(frames[-1][:3], [100 * v for v in printed[-1]["root"]]), 0.01)
            again = lines(self, "motion", path, "--json", "--raw")
            self.assertEqual(len(again), 31)
            for bone, q in printed[-1]["bones"].items():
                if bone.endswith(("Foot", "Toes")):  # a BVH file ends at the ankle's own end
                    continue
                dot = abs(sum(a * b for a, b in zip(q, again[-1]["bones"][bone])))
                self.assertGreater(dot, math.cos(math.radians(2.5)), bone)
            half = lines(self, "motion", path, "--json", "--scale", "0.005")
            self.assertAlmostEqual(half[-1]["root"][0], again[-1]["root"][0] / 2, delta=0.02)
            body, moved = pathlib.Path(folder) / "body.vrm", pathlib.Path(folder) / "moved.vrm"
            self.assertEqual(run("character", "--rig", "vrm1", "--out", body).returncode, 0)
            for source in (path, table):
                done = run("character", body, "--motion", source, "--frames", 5, "--out", moved)
                self.assertEqual(done.returncode, 0, done.stderr)
                glb = moved.read_bytes()
                document_size = struct.unpack_from("<I", glb, 12)[0]
                gltf = json.loads(glb[20 : 20 + document_size])
                times = gltf["accessors"][gltf["animations"][0]["samplers"][0]["input"]]
                self.assertEqual(times["count"], 5)
                self.assertAlmostEqual(times["max"][0], 4 / 30, places=3)
            text = path.read_text()
            for bad, words in (
                (text[:-20], ("the file ends", "frame 30 of 31")),
                (text.replace("Left", "Steuerbord"), ("leftUpperLeg", "bone map", "--nodes")),
                (text.replace("Frame Time: 0", "Frame Time: nan0"), ("frame time", "nan0")),
            ):
                path.write_text(bad)
                self.check_failure(run("motion", path, "--json"), str(path), *words)
            path.write_text(text.replace("Left", "Steuerbord"))
            told = run("motion", path, "--nodes")
            self.assertEqual(told.returncode, 0, told.stderr)
            self.assertIn("\n      SteuerbordLowerLeg\n", told.stdout)
            self.assertEqual(json.loads(told.stdout.split("Its nodes")[0])["leftUpperLeg"], "")
            self.assertEqual(run("motion", table, "--scale", "1").returncode, 2)
            run("motion", table, "--bvh", path, "--bvh-rate", "60")
            self.assertEqual(len(bvh_file(path)[2]), 61)

    def test_what_cannot_be_sent_or_read_as_joints_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder) / "joints.csv"
            for text, words in (
                ("", ("empty", "time_s")),
                ("a,b\n", ("line 1", "'a'", "Kinect v2")),
                (joint_table(swaying(9)).replace("NECK_y", "NOSE_y"), ("line 1", "'NOSE_y'", "LEFT_ELBOW")),
                (joint_table(swaying(9))[:-9], ("line 10", "columns")),
                (joint_table(swaying(9), unit=1000), ("millimetres?",)),
                (joint_table([{"HEAD": (0, 1.6, -2), "LEFT_HAND": (0.3, 1.0, -2)}] * 9), ("trunk", "PELVIS")),
            ):
                table.write_text(text)
                self.check_failure(run("motion", table, "--json"), str(table), *words)
            table.write_text(joint_table(swaying(9)))
            self.check_failure(run("motion", table, "--bvh", f"{folder}/no/such.bvh"), "no/such.bvh")
            self.check_failure(run("motion", table, "--vmc", "no-such-host.invalid:39539"), "no-such-host")
            for address in ("localhost", "localhost:0", "localhost:65536", ":9000", "localhost:vmc"):
                done = run("motion", table, "--vmc", address)
                self.assertEqual(done.returncode, 2, address)
                self.assertIn(f"'{address}'", done.stderr)
            for option in (("--active", "1"), ("--joints", "tracked"), ("--user-map", "tracked")):
                self.assertEqual(run("motion", table, *option).returncode, 2, option)
            table.write_text(
                joint_table(swaying(9)).replace("LEFT_SHOULDER", "LEFT_TOES").replace("NECK", "CHEST")
            )
            unseen = pathlib.Path(folder) / "unseen.bvh"
            self.check_failure(run("motion", table, "--json", "--bvh", unseen), "trunk")
            self.assertFalse(unseen.exists(), "no empty file is left")

    def test_a_recording_of_a_sensor_measures_as_the_sensor_does(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rec"
            self.assertEqual(document(self, "record", VIRTUAL, path, "--frames", 40, "--json")["frames"], 40)
            direct = document(self, "measure", VIRTUAL, "--json")["measurements"]
            replay = document(self, "measure", path, "--json")["measurements"]
            for key, m in direct.items():
                half = 0.05 if key.endswith("_kg") else 0.0005  # a tenth of a kilogram, a millimetre
                self.assertAlmostEqual(m["value"], replay[key]["value"], delta=half, msg=key)
            self.check_failure(run("record", VIRTUAL, path, "--frames", 1), str(path))

    def test_a_source_takes_options_in_its_uri(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rec"
            document(self, "record", VIRTUAL, path, "--frames", 12, "--json")

            def bodies(source):
                return [frame["bodies"] for frame in lines(self, "track", source, "--json")]

            whole = bodies(path)
            self.assertEqual(len(whole), 12)
            self.assertEqual(bodies(f"recording:{path}?start=5"), whole[5:])
            self.assertEqual(bodies(f"recording:{path}?start=5&count=4"), whole[5:9])
            self.assertEqual(bodies(f"{path}?start=5&count=4"), whole[5:9])
            self.assertEqual(bodies(f"{path}?"), whole)
            fitted = document(
                self,
                "fit",
                f"recording:{path}?start=5",
                "--draft",
                "--out",
                path.with_name("out"),
                "--json",
            )
            self.assertEqual(fitted["frames"], 7)
            few = VIRTUAL.replace("60", "3").split(":")[1]
            self.assertEqual(bodies("virtual:?" + few), bodies("virtual:" + few))

    def test_a_looped_recording_plays_again_and_again(self):
        with tempfile.TemporaryDirectory() as folder:
            path, again = pathlib.Path(folder) / "rec", pathlib.Path(folder) / "again"
            document(self, "record", VIRTUAL, path, "--frames", 12, "--json")

            def measured(query):
                source = f"recording:{path}?{query}"
                return document(self, "measure", source, "--method", "paper", "--json")["frames"]

            self.assertEqual((measured("start=5"), measured("loop=1&start=5")), (7, 30))
            document(self, "record", f"{path}?loop=1&start=9", again, "--frames", 10, "--json")
            for i in range(10):
                self.assertEqual(
                    (again / "depth" / f"{i:06}.png").read_bytes(),
                    (path / "depth" / f"{9 + i % 3:06}.png").read_bytes(),
                    i,
                )
            rows = (again / "timestamps.csv").read_text().splitlines()[1:]
            times = [int(row.split(",")[1]) for row in rows]
            self.assertEqual(len(times), 10)
            self.assertTrue(all(a < b for a, b in zip(times, times[1:])), times)

    def test_a_wrong_option_of_a_source_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rec"
            document(self, "record", VIRTUAL, path, "--frames", 12, "--json")
            for query, *words in (
                ("start=-1", "start", "'-1'", "0..11"),
                ("start=abc", "start", "'abc'", "0..11"),
                ("start=99999", "start", "'99999'", "0..11"),
                ("start=12", "start", "'12'", "0..11"),
                ("loop=yes", "loop", "'yes'", "0..1"),
                ("pace=fast", "pace", "'fast'", "realtime"),
                ("volume=1", "'volume'", "loop, start, count"),
                ("start=1&start=2", "start", "'1'", "'2'", "once"),
                ("=5", "'=5'", "no key", "KEY=VALUE"),
                ("loop", "'loop'", "no value", "KEY=VALUE"),
            ):
                for source in (f"recording:{path}?{query}", f"{path}?{query}"):
                    with self.subTest(source):
                        self.check_failure(run("measure", source, "--json"), *words)
            self.check_failure(run("measure", f"{path}x?start=1"), f"{path}x?start=1", "recording")
        self.check_failure(run("measure", VIRTUAL + "&volume=1"), "'volume'", "seed", "shape keys")
        self.check_failure(run("measure", VIRTUAL + "&seed=4"), "seed", "'3'", "'4'", "once")

    @unittest.skipIf(os.name == "nt", "a path of Windows has no question mark")
    def test_a_path_with_a_question_mark_is_opened_as_it_is_or_encoded(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rec?start=9"
            document(self, "record", VIRTUAL, path, "--frames", 12, "--json")
            encoded = str(path).replace("?", "%3F")
            for source, count in (
                (path, 12),
                (f"{path}?start=10", 2),
                (f"recording:{encoded}", 12),
                (f"recording:{encoded}?count=5", 5),
            ):
                self.assertEqual(len(lines(self, "track", source, "--json")), count, source)
            self.check_failure(run("track", f"recording:{path}"), f"{folder}/rec", "no such folder")
            self.check_failure(run("track", encoded), encoded)

    def test_a_person_who_leaves_and_returns_does_not_end_the_chain(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rec"
            document(self, "record", VIRTUAL, path, "--frames", 20, "--json")
            rows = (path / "joints.csv").read_text().splitlines(keepends=True)
            (path / "joints.csv").write_text(
                "".join(r for r in rows if r.split(",")[0] not in ("7", "8", "9"))
            )
            bodies = [len(f["bodies"]) for f in lines(self, "track", path, "--json")]
            self.assertEqual(bodies, [1] * 7 + [0] * 3 + [1] * 10)
            self.assertEqual(
                [f["frame"] for f in lines(self, "motion", path, "--json")],
                [i for i in range(20) if i not in (7, 8, 9)],
            )
            self.assertEqual(document(self, "measure", path, "--json")["frames"], 17)
            # Gone for good before the scan is complete: what there is of the person is fitted.
            (path / "joints.csv").write_text("".join(r for r in rows if r.split(",")[0] not in ("18", "19")))
            fitted = document(self, "fit", path, "--draft", "--out", path.with_name("out"), "--json")
            self.assertEqual((fitted["scan_frames"], fitted["frames"]), (18, 18))

    def test_a_second_person_is_not_averaged_into_the_first(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rec"
            document(self, "record", VIRTUAL, path, "--frames", 20, "--json")
            rows = (path / "joints.csv").read_text().splitlines(keepends=True)
            self.assertEqual(rows[1].split(",")[:2], ["0", "1"])
            (path / "joints.csv").write_text(
                "".join(rows[:11]) + "".join(r.replace(",1,", ",2,", 1) for r in rows[11:])
            )
            self.assertEqual(document(self, "measure", path, "--json")["frames"], 10)

    def test_the_active_person_is_followed(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rec"
            document(self, "record", VIRTUAL, path, "--frames", 40, "--json")
            head, *rows = (path / "joints.csv").read_text().splitlines(keepends=True)
            # A second person, half a metre behind and a metre to the side of the first.
            names = head.strip().split(",")

            def moved(row):
                shift = {"_x": 1.0, "_z": 0.5}
                cells = zip(names, row.strip().split(","))
                return (
                    ",".join(
                        "2" if n == "id" else str(float(c) + shift[n[-2:]]) if n[-2:] in shift and c else c
                        for n, c in cells
                    )
                    + "\n"
                )

            (path / "joints.csv").write_text(head + "".join(r + moved(r) for r in rows))

            def follow(*args):
                return [f["joints"]["TORSO"] for f in lines(self, "motion", path, "--json", *args)]

            nearest, second = follow(), follow("--active", "2")
            self.assertEqual(follow("--active", "nearest"), nearest)
            self.assertEqual(follow("--active", "centred"), nearest)
            self.assertEqual(follow("--active", "first"), nearest)
            self.assertEqual(len(second), 40)
            self.assertTrue(all(b[0] - a[0] > 0.8 for a, b in zip(nearest, second)))
            self.assertEqual(follow("--active", "9"), [])
            frames = lines(self, "track", path, "--active", "2", "--json")
            self.assertEqual({f["active"] for f in frames}, {2})
            self.assertEqual({len(f["bodies"]) for f in frames}, {2})
            self.check_failure(run("measure", path, "--json"), "more than one person")
        for wrong in ("", "0", "256", "-1", "tallest", "1.5", "99999999999"):
            self.assertEqual(run("track", VIRTUAL, "--active", wrong).returncode, 2, wrong)

    def test_a_refused_scan_counts_its_reasons(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rec"
            document(self, "record", VIRTUAL, path, "--frames", 20, "--json")
            head, *rows = (path / "joints.csv").read_text().splitlines(keepends=True)
            # Two people in frames 0 to 11, none in the others.
            rows = [r for r in rows if int(r.split(",")[0]) < 12]
            twice = [r + r.replace(",1,", ",2,", 1) for r in rows]
            (path / "joints.csv").write_text(head + "".join(twice))
            reasons = "12 of 20 frames: more than one person is in view; 8: no person is in view"
            picture = pathlib.Path(folder) / "depth.png"
            for args in (
                ("measure", path, "--json"),
                ("fit", path, "--draft", "--out", pathlib.Path(folder) / "out"),
                ("plot", path, "--what", "depth", "--out", picture),
            ):
                self.check_failure(run(*args), f"no frame could be used: {reasons}")

    def test_a_pause_in_the_time_stamps_costs_no_time(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rec"
            document(self, "record", VIRTUAL, path, "--frames", 12, "--json")
            head, *rows = (path / "timestamps.csv").read_text().splitlines()
            week_ns = 7 * 86400 * 10**9
            rows = [f"{n},{int(t) + (week_ns if int(n) > 5 else 0)}" for n, t in (r.split(",") for r in rows)]
            (path / "timestamps.csv").write_text("\n".join([head, *rows]) + "\n")
            result = document(self, "fit", path, "--draft", "--out", path.with_name("out"), "--json")
            self.assertEqual(result["frames"], 12)
            self.assertTrue(all(math.isfinite(x) for x in numbers(result)))

    def test_a_source_without_end_is_fitted_in_a_moment(self):
        with tempfile.TemporaryDirectory() as folder:
            result = document(
                self, "fit", VIRTUAL.replace("frames=60", "rate=5"), "--draft", "--out", folder, "--json"
            )
            self.assertEqual(result["frames"], 41, "eight seconds at 5 Hz")

    def test_plot_draws_the_papers_curves(self):
        with tempfile.TemporaryDirectory() as folder:
            for what in ("depth", "feet"):
                path = pathlib.Path(folder) / f"{what}.png"
                plotted = document(self, "plot", VIRTUAL, "--what", what, "--out", path, "--json")
                self.assertGreater(plotted["points"], 20)
                self.assertEqual(path.read_bytes()[:4], b"\x89PNG")

    def test_a_character_is_written_told_and_moved(self):
        with tempfile.TemporaryDirectory() as folder:
            file, moved, shown = (
                pathlib.Path(folder) / name for name in ("body.vrm", "moved.glb", "shown.png")
            )
            self.assertEqual(run("character", "--rig", "vrm0", "--sex", "m", "--out", file).returncode, 0)
            about = document(
                self,
                "character",
                file,
                "--motion",
                VIRTUAL,
                "--frames",
                5,
                "--out",
                moved,
                "--picture",
                shown,
                "--json",
            )
            self.assertEqual((about["kind"], about["bones"]["leftUpperArm"]), ("VRM 0", "J_leftUpperArm"))
            self.assertEqual(about["parts"], [{"mesh": "body", "material": "skin", "triangles": 27420}])
            data = moved.read_bytes()
            content = json.loads(data[20 : 20 + struct.unpack("<I", data[12:16])[0]])
            self.assertEqual(
                len(content["animations"][0]["channels"]), len(about["bones"]) + 1
            )  # and the hips' place
            self.assertEqual([i["mimeType"] for i in content["images"]], ["image/png"])
            self.assertGreater(len(set(picture(shown)[2])), 10)
            self.check_failure(
                run("character", file, "--motion", VIRTUAL, "--frames", 2, "--out", "/no/folder/moved.glb"),
                "/no/folder/moved.glb",
            )
            # The same as text with its buffer and picture beside it: the moved copy has them in it.
            data = file.read_bytes()
            size = struct.unpack("<I", data[12:16])[0]
            content, buffer = json.loads(data[20 : 20 + size]), data[28 + size :]
            view = content["bufferViews"][content["images"][0].pop("bufferView")]
            texture = buffer[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
            content["images"][0] = {"uri": "skin.png"}
            content["buffers"][0]["uri"] = "body.bin"
            beside = pathlib.Path(folder) / "beside"
            beside.mkdir()
            for name, what in (
                ("skin.png", texture),
                ("body.bin", buffer),
                ("body.gltf", json.dumps(content).encode()),
            ):
                (beside / name).write_bytes(what)
            document(
                self,
                "character",
                beside / "body.gltf",
                "--motion",
                VIRTUAL,
                "--frames",
                2,
                "--out",
                moved,
                "--json",
            )
            data = moved.read_bytes()
            size = struct.unpack("<I", data[12:16])[0]
            content, buffer = json.loads(data[20 : 20 + size]), data[28 + size :]
            self.assertNotIn("uri", content["buffers"][0])
            view = content["bufferViews"][content["images"][0]["bufferView"]]
            self.assertEqual(buffer[view.get("byteOffset", 0) :][: view["byteLength"]], texture)
            unnamed = pathlib.Path(folder) / "unnamed.glb"
            self.assertEqual(
                run("character", "--rig", "mixamo", "--sex", "m", "--out", unnamed).returncode, 0
            )
            unnamed.write_bytes(
                unnamed.read_bytes().replace(b"LeftUpLeg", b"Something").replace(b"LeftLeg", b"Another")
            )
            self.check_failure(run("character", unnamed), "no bone for leftUpperLeg", "--nodes")
            told = run("character", unnamed, "--nodes")
            self.assertEqual(told.returncode, 0, told.stderr)
            end = told.stdout.index("Its nodes:")
            self.assertEqual(json.loads(told.stdout[:end])["leftUpperLeg"], "")
            self.assertIn("Something\n", told.stdout[end:])
        self.check_failure(run("character", "/no/character.vrm"), "/no/character.vrm", "cannot be read")
        self.check_failure(run("character"), "file")
        self.assertEqual(run("character", "--rig", "sausage", "--out", "x.glb").returncode, 2)

    def test_fit_leaves_everything_it_promises(self):
        with tempfile.TemporaryDirectory() as folder:
            document(self, "fit", VIRTUAL, "--garment", "sundress", "--frames", 8, "--out", folder, "--json")
            out = pathlib.Path(folder)
            result = json.loads((out / "result.json").read_text())
            for name in result["pictures"] + ["avatar.glb"]:
                self.assertGreater((out / name).stat().st_size, 1000, name)
            self.assertIn("contact_sheet.png", result["pictures"])
            self.assertEqual(result["cloth"]["simulated"], 4144)
            glb = (out / "avatar.glb").read_bytes()
            self.assertEqual(struct.unpack("<4sII", glb[:12]), (b"glTF", 2, len(glb)))

    def test_fit_dresses_by_the_sex_that_the_scan_finds(self):
        with tempfile.TemporaryDirectory() as folder:
            for sex, outfit in (("f", ["sundress"]), ("m", ["pants_men", "shirt_men"])):
                person = f"virtual:motion=scan&sex={sex}&sensor=kinect_v1_320&seed=3&frames=40"
                result = document(self, "fit", person, "--draft", "--frames", 2, "--out", folder, "--json")
                self.assertEqual((result["sex"]["value"], result["sex"]["told"]), (sex, False))
                self.assertGreater(result["sex"]["probability"], 0.5)
                self.assertEqual(result["garment"], "+".join(outfit))
                self.assertEqual([g["garment"] for g in result["garments"]], outfit)
                self.assertEqual(result["method"], "fit")
            told = document(
                self, "fit", person, "--sex", "f", "--draft", "--frames", 2, "--out", folder, "--json"
            )
            self.assertEqual(told["sex"], {"value": "f", "probability": 1.0, "told": True})
            self.assertEqual(told["garment"], "sundress")

    def test_every_bundled_garment_is_listed_sized_and_worn(self):
        listed = document(self, "fit", "--garment", "list", "--json")
        names = [g["garment"] for g in listed]
        self.assertEqual(names, sorted(p.stem for p in GARMENTS.glob("*.json")))
        self.assertEqual(len(run("fit", "--garment", "list").stdout.splitlines()), len(names))
        with tempfile.TemporaryDirectory() as folder:
            for garment in listed:
                person = (
                    f"virtual:motion=scan&sex={garment['made_for']}&sensor=kinect_v1_320&seed=3&frames=40"
                )
                result = document(
                    self,
                    "fit",
                    person,
                    "--garment",
                    garment["garment"],
                    "--draft",
                    "--frames",
                    2,
                    "--out",
                    folder,
                    "--json",
                )
                worn = result["garments"][0]
                self.assertEqual((worn["kind"], worn["chart"]), (garment["kind"], garment["chart"]))
                self.assertAlmostEqual(sum(s["probability"] for s in worn["sizes"]), 1.0, places=3)
                self.assertTrue(set(garment["sizes"]) <= {s["label"] for s in worn["sizes"]}, garment)

    def test_fit_says_in_every_place_whether_cloth_is_torn(self):
        for source in [VIRTUAL, *RECORDINGS[:2]]:
            with tempfile.TemporaryDirectory() as folder:
                done = run("fit", source, "--draft", "--out", folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                result = json.loads((pathlib.Path(folder) / "result.json").read_text())
                self.assertEqual(result["torn"], result["worst_strain"]["strain"] > 1.0, source)
                self.assertEqual(result["torn"], "TORN" in done.stdout, source)
                self.assertEqual(result["torn"], "warning" in result, source)
                self.assertGreaterEqual(
                    result["worst_strain"]["strain"], result["cloth"]["strain_max"] - 1e-6
                )

    def test_fit_takes_outfits_charts_and_kinds(self):
        person = "virtual:motion=scan&sex=m&sensor=kinect_v1_320&seed=3&frames=40"
        quick = ("--draft", "--frames", 2)
        with tempfile.TemporaryDirectory() as folder:
            result = document(
                self,
                "fit",
                person,
                *quick,
                "--garment",
                "pants_men+vest",
                "--chart",
                "paper",
                "--kind",
                "short_sleeves",
                "--method",
                "paper",
                "--out",
                folder,
                "--json",
            )
            self.assertEqual([g["chart_kind"] for g in result["garments"]], ["short_sleeves"] * 2)
            self.assertEqual((result["chart"], result["method"]), ("paper", "paper"))
            layers = [g["cloth"]["vertices"] for g in result["garments"]]
            self.assertEqual(result["cloth"]["vertices"], sum(layers))
            glb = (pathlib.Path(folder) / "avatar.glb").read_bytes()
            for name in ("pants_men", "vest"):
                self.assertIn(b'"' + name.encode() + b'"', glb)
            out = ("--out", folder)
            # A chart that the user names must know the garment; the one that a garment names always does.
            self.check_failure(
                run("fit", person, *quick, "--garment", "duster", "--chart", "paper", *out), "paper", "jacket"
            )
            self.check_failure(run("fit", person, *quick, "--garment", "vest+", *out), "vest+")
            self.check_failure(run("fit", person, *quick, "--garment", "vest+toga", *out), "toga", "sundress")
        for lacking, word in ((("fit", "--out", "x"), "source"), (("fit", person), "--out")):
            done = run(*lacking)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(word, done.stderr)

    def test_a_garment_size_changes_the_dress(self):
        with tempfile.TemporaryDirectory() as folder:
            result = document(
                self, "fit", VIRTUAL, "--size", "XL", "--draft", "--frames", 2, "--out", folder, "--json"
            )
            self.assertEqual(result["size"], "XL")
            self.check_failure(run("fit", VIRTUAL, "--size", "QQ", "--out", folder), "QQ")

    def test_wear_shows_sizes_and_layers_side_by_side(self):
        with tempfile.TemporaryDirectory() as folder:
            report = document(
                self,
                "wear",
                "jeans_women+vest,sundress_pattern",
                "--size",
                "S,XXL",
                "--draft",
                "--out",
                folder,
                "--json",
            )
            self.assertEqual(
                [(o["outfit"], o["size"]) for o in report["outfits"]],
                [
                    ("jeans_women+vest", "S"),
                    ("jeans_women+vest", "XXL"),
                    ("sundress_pattern", "S"),
                    ("sundress_pattern", "XXL"),
                ],
            )
            zones = {
                (o["outfit"], o["size"]): {k: z["fit"] for g in o["garments"] for k, z in g["zones"].items()}
                for o in report["outfits"]
            }
            self.assertEqual(
                zones["sundress_pattern", "S"]["chest_girth_m"], "right"
            )  # as vfit size recommends for her
            self.assertEqual(zones["sundress_pattern", "XXL"]["chest_girth_m"], "loose")
            self.assertGreater((pathlib.Path(folder) / "worn.png").stat().st_size, 10000)
            heavy = document(
                self,
                "wear",
                "jeans_women",
                "--size",
                "XS",
                "--shape",
                "weight=1.15",
                "--draft",
                "--out",
                folder,
                "--json",
            )
            self.assertIn("hip_girth_m", heavy["outfits"][0]["not_wearable"])
            self.check_failure(run("wear", "jeans_women", "--size", "QQ", "--out", folder), "QQ")
            self.check_failure(run("wear", "no_such", "--out", folder), "no_such")
            self.check_failure(run("wear", "vest", "--shape", "weight", "--out", folder), "KEY=NUMBER")

    def test_a_garment_of_ones_own_is_cooked_and_worn(self):
        design = pathlib.Path(__file__).resolve().parents[2] / "assets" / "garments" / "sundress.json"
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            text = design.read_text().replace('"name": "sundress"', '"name": "\\"mine\\""')
            (folder / "design.json").write_text(text)
            cooked = document(self, "cook", folder / "design.json", "--out", folder / "mine.json", "--json")
            self.assertEqual(cooked["garment"], '"mine"')
            result = document(
                self,
                "fit",
                VIRTUAL,
                "--garment",
                folder / "mine.json",
                "--draft",
                "--frames",
                2,
                "--out",
                folder / "out",
                "--json",
            )
            self.assertEqual(result["cloth"]["vertices"], cooked["vertices"])
            # A kind that its chart does not list: worn, with the reason why no size is recommended.
            self.assertEqual(cooked["kind"], "dress")
            (folder / "gown.json").write_text(
                (folder / "mine.json").read_text().replace('"dress"', '"gown"', 1)
            )
            worn = ("--garment", folder / "gown.json", "--draft", "--frames", 2, "--out", folder / "out")
            done = run("fit", VIRTUAL, *worn)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"gown\.json: no size: .*en13402_women.*\bgown\b.*\bdress\b")
            self.check_failure(
                run("cook", folder / "design.json", "--out", folder / "no" / "x.json"), "x.json"
            )
            (folder / "none").mkdir()
            self.check_failure(run("cook", folder / "none", "--out", folder / "all"), str(folder / "none"))
            (folder / "catalogue" / "more").mkdir(parents=True)
            (folder / "catalogue" / "a.json").write_text(text)
            (folder / "catalogue" / "more" / "a.json").write_text(text)
            (folder / "catalogue" / "notes.json").write_text("{}")
            report = document(self, "cook", folder / "catalogue", "--out", folder / "all", "--json")
            self.assertEqual(
                [pathlib.Path(c["file"]).name for c in report["cooked"]], ["a.json", "more_a.json"]
            )
            self.assertEqual([pathlib.Path(c).name for c in report["left_out"]], ["notes.json"])
            self.assertEqual(json.loads((folder / "all" / "report.json").read_text()), report)
            (folder / "catalogue" / "b.json").write_text(text.replace('"columns": 72', '"columns": 3'))
            failed = run("cook", folder / "catalogue", "--out", folder / "all", "--json")
            self.assertEqual(failed.returncode, 1)
            self.assertIn("columns", json.loads(failed.stdout)["failed"][0]["error"])
            self.assertEqual(len(json.loads(failed.stdout)["cooked"]), 2)
            (folder / "design.json").write_text("{")
            self.check_failure(run("cook", folder / "design.json", "--out", folder / "x.json"))
            self.check_failure(
                run("fit", VIRTUAL, "--garment", folder / "gone.json", "--out", folder), "gone.json"
            )
            self.check_failure(
                run("fit", VIRTUAL, "--garment", folder / "design.json", "--out", folder), "design.json"
            )

    def test_a_character_wears_a_garment_for_good(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for rig, suffix in (("vrm0", "vrm"), ("mixamo", "glb")):
                file, worn = folder / f"body.{suffix}", folder / f"worn.{suffix}"
                self.assertEqual(run("character", "--rig", rig, "--sex", "f", "--out", file).returncode, 0)
                report = document(
                    self, "refit", "vest", file, "--out", worn, "--picture", folder / "worn.png", "--json"
                )
                self.assertEqual(report["garments"][0]["skin_crossings"], 0)
                self.assertEqual(report["garments"][0]["self_crossings"], 0)
                self.assertGreater(report["hidden_triangles"], 500)
                self.assertEqual(report["outside"], [])
                self.assertGreater(min(picture(folder / "worn.png")[:2]), 200)
                before, after = (document(self, "character", path, "--json") for path in (file, worn))
                self.assertEqual(after["kind"], before["kind"])
                self.assertEqual(after["bones"], before["bones"])
                self.assertAlmostEqual(after["stature_m"], before["stature_m"], places=3)
                triangles = {part["mesh"]: part["triangles"] for part in after["parts"]}
                vest = len(json.loads((GARMENTS / "vest.json").read_text())["indices"]) // 3
                self.assertEqual(triangles["vest"], vest)
                self.assertEqual(
                    triangles["body"], before["parts"][0]["triangles"] - report["hidden_triangles"]
                )
                if rig == "vrm0":  # its meshes stand in the file's world
                    data = worn.read_bytes()
                    (size,) = struct.unpack_from("<I", data, 12)
                    gltf = json.loads(data[20 : 20 + size])
                    low, high = {}, {}
                    for mesh in gltf["meshes"]:
                        place = gltf["accessors"][mesh["primitives"][0]["attributes"]["POSITION"]]
                        low[mesh["name"]], high[mesh["name"]] = place["min"], place["max"]
                    self.assertGreater(low["vest"][1], 0.4 * high["body"][1])
                    self.assertLess(high["vest"][1], 0.95 * high["body"][1])
                    for axis in (0, 2):
                        middle = (low["vest"][axis] + high["vest"][axis]) / 2
                        self.assertAlmostEqual(middle, 0.0, delta=0.06)
                        self.assertGreater(high["vest"][axis] - low["vest"][axis], 0.2)
                moved = ("refit", worn, "--garments", "vest", "--motion", VIRTUAL, "--frames", 8, "--json")
                judged = run_program(pathlib.Path(VFIT).with_name("vfit-bench"), *moved)
                self.assertEqual(judged.returncode, 0, judged.stderr)
                (motion,) = json.loads(judged.stdout)
                self.assertGreater(motion["frames"], 4)
                self.assertLess(motion["frames_crossing_not_by_hands"], motion["frames"] / 2)
            # What is wrong is said, and nothing is written.
            for arguments, words in (
                (("vest", file, "--out", file), "own file"),
                (("vest", file, "--out", folder / "x.glb", "--take-off", "cape"), '"body"'),
                (("no_such_garment", file, "--out", folder / "x.glb"), "no_such_garment"),
                (("vest", GARMENTS / "vest.json", "--out", folder / "x.glb"), "glTF"),
            ):
                failed = run("refit", *arguments)
                self.assertNotEqual(failed.returncode, 0)
                self.assertIn(words, failed.stderr)
                self.assertFalse((folder / "x.glb").exists())

    def test_a_garment_is_altered_until_it_has_the_ease(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            alter = ("alter", GARMENTS / "vest.json", "--draft", "--out", folder / "out")
            wanted = ("--size", "L", "--sex", "f", "--ease", "chest=8,waist=10")
            ticket = document(self, *alter, *wanted, "--json")
            changes = {change["place"]: change for change in ticket["changes"]}
            self.assertEqual(sorted(changes), ["chest", "waist"])
            for place, ease_m in (("chest", 0.08), ("waist", 0.1)):
                self.assertAlmostEqual(changes[place]["ease_goal_m"], ease_m, places=4)
                self.assertAlmostEqual(changes[place]["ease_after_m"], ease_m, delta=0.005)
                self.assertLess(changes[place]["by_m"], -0.05)
            text = (folder / "out" / "ticket.txt").read_text()
            self.assertRegex(text, r"chest: take in [\d.]+ cm \(ease [\d.]+ cm, then (8(\.\d)?|7\.\d) cm\)")
            self.assertGreater(min(picture(folder / "out" / "ticket.png")[:2]), 200)
            # What a file calls itself is no path.
            foreign = json.loads((GARMENTS / "vest.json").read_text()) | {"name": "../../vest"}
            (folder / "foreign.json").write_text(json.dumps(foreign))
            other = document(
                self, "alter", folder / "foreign.json", "--draft", "--out", folder / "f", *wanted, "--json"
            )
            self.assertEqual(pathlib.Path(other["altered"]), folder / "f" / "foreign_altered.json")
            self.assertEqual([path.name for path in folder.glob("*_altered.json")], [])
            # The altered size is a garment as any other, and has nothing left to change; it can be made anew.
            document(self, "alter", ticket["altered"], "--draft", "--out", folder / "f", *wanted, "--json")
            again = ("alter", ticket["altered"], "--draft", "--out", folder / "again", "--json")
            left = document(self, *again, "--size", "L altered", "--sex", "f", "--ease", "chest=8,waist=10")
            self.assertEqual(left["changes"], [])
            self.assertEqual(left["altered"], "")
            for bad, word in (
                (("--size", "Q"), "no size Q"),
                (("--size", "L", "--ease", "hip=9"), "does not go round the hip"),
                (("--size", "L", "--ease", "chest=-90"), "half of the body's girth"),
            ):
                self.check_failure(run(*alter, *bad), word)
            self.assertEqual(run(*alter, "--size", "L", "--ease", "chest=wide").returncode, 2)
            self.check_failure(
                run("alter", GARMENTS / "sundress.json", "--size", "M", "--out", folder / "x"), "flat panels"
            )

    def test_a_catalogue_goes_on_where_it_was_ended(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            designs, out = folder / "designs", folder / "out"
            designs.mkdir()
            source = pathlib.Path(__file__).resolve().parents[2] / "assets" / "garments"
            for name in ("vest", "shirt_men", "pants_men"):
                shutil.copy(source / f"{name}.json", designs)
            (designs / "broken<b>.obj").write_text("v 0 0 0\nf 1 2 3\n")
            cook = ("cook", designs, "--out", out, "--jobs", 2)
            states = lambda report: [design["state"] for design in report["designs"]]  # noqa: E731
            done = run(*cook, "--limit", 1, "--triangle", 6, "--json")  # long on any machine
            self.assertEqual(done.returncode, 1)
            self.assertIn("longer than 1 s", done.stdout)
            self.assertIn("over_time", states(json.loads(done.stdout)))
            done = run(*cook, "--resume", "--json")
            report = json.loads(done.stdout)
            self.assertEqual(states(report), ["failed", "cooked", "cooked", "cooked"])
            self.assertIn("the face names vertex 2 of 1", report["failed"][0]["error"])
            page = (out / "report.html").read_text()
            self.assertIn("3 cooked, 1 failed", page)
            self.assertIn("broken&lt;b&gt;", page)
            for name in ("vest", "shirt_men", "pants_men"):
                self.assertIn(f'src="pictures/{name}.png"', page)
                width, height, _ = picture(out / "pictures" / f"{name}.png")
                self.assertGreater(min(width, height), 200)

            def stamps():
                return {path.name: path.stat().st_mtime_ns for path in out.glob("*[nt].json")}

            # A kill in the midst of a line, a design that was edited, a garment file that was taken away.
            before = stamps()
            with (out / "designs.jsonl").open("a") as journal:
                key = {"design": str(designs / "vest.json"), "key": 1, "state": "cooked"}
                journal.write(json.dumps(key) + '\n[1]\n{"design": 3, "key": "x"}\n{"design": "')
            again = json.loads(run(*cook, "--resume", "--json").stdout)
            self.assertEqual(again, report)
            self.assertEqual(stamps(), before | {"report.json": stamps()["report.json"]})
            text = (designs / "vest.json").read_text()
            (designs / "vest.json").write_text(text.replace('"vest"', '"waistcoat"', 1))
            (out / "pants_men.json").unlink()
            again = json.loads(run(*cook, "--resume", "--json").stdout)
            self.assertEqual(states(again), states(report))
            after = stamps()
            self.assertEqual(after["shirt_men.json"], before["shirt_men.json"])
            self.assertNotEqual(after["vest.json"], before["vest.json"])
            self.assertIn('"waistcoat"', (out / "vest.json").read_text())
            self.assertIn("pants_men.json", after)
            # Killed after the first design.
            shutil.rmtree(out)
            with subprocess.Popen(
                [VFIT, "cook", designs, "--out", out, "--jobs", "1"],
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
                start_new_session=True,
            ) as process:
                process.stdout.readline()
                process.stdout.readline()
                os.killpg(process.pid, signal.SIGKILL)
            kept = (out / "pants_men.json").stat().st_mtime_ns
            again = json.loads(run(*cook, "--resume", "--json").stdout)
            self.assertEqual(states(again), states(report))
            self.assertEqual((out / "pants_men.json").stat().st_mtime_ns, kept)
            # Designs below OUT are designs; OUT itself is none.
            self.check_failure(run("cook", designs, "--out", designs), "folder of the designs")
            inside = folder / "around" / "designs"
            inside.mkdir(parents=True)
            shutil.copy(source / "vest.json", inside / "a #1.json")
            around = document(self, "cook", inside, "--out", folder / "around", "--json")
            self.assertEqual(states(around), ["cooked"])
            self.assertIn('src="pictures/a%20%231.png"', (folder / "around" / "report.html").read_text())
            for wrong in (("--resume",), ("--jobs", 2), ("--limit", 9)):
                done = run("cook", designs / "vest.json", "--out", folder / "x.json", *wrong)
                self.assertEqual(done.returncode, 2)
            self.assertEqual(run(*cook, "--picture", folder / "x.png").returncode, 2)

    def test_patterns_of_others_are_made_on_the_body_that_they_were_drawn_for(self):
        garments = pathlib.Path(SHARED) / "data/field/garments"
        if not garments.exists():
            self.skipTest("no shared/data/field/garments")
        measures = garments / "rand_body_measurements.yaml"
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for name, hangs_on, round_ in (
                ("rand_D5QKH709Q5", "shoulders", "hips"),
                ("rand_J1B2HTPIMP", "waist", "hips"),
                ("rand_MZL130QZO6", "shoulders", "chest"),
            ):
                made = folder / f"{name}.json"
                spec = garments / f"{name}_specification.json"
                cooked = document(self, "cook", spec, "--measures", measures, "--out", made, "--json")
                self.assertEqual(cooked["hangs_on"], hangs_on)
                self.assertIn(round_, cooked["goes_round"])
                self.assertEqual((cooked["skin_crossings"], cooked["self_crossings"]), (0, 0))
                self.assertEqual(json.loads(made.read_text())["version"], 3)
                worn = run("wear", made, "--draft", "--out", folder / "worn")
                self.assertEqual(worn.returncode, 0, worn.stderr)
            for name, reason in (
                ("made_far", "left_btorso is placed 5.1 m beside the body"),
                ("made_nostitch", "hangs on nothing"),
            ):
                spec = garments / f"{name}_specification.json"
                self.check_failure(run("cook", spec, "--out", folder / "x.json"), reason)
            skirt = garments / "rand_J1B2HTPIMP_specification.json"
            self.check_failure(
                run("cook", skirt, "--measures", measures, "--kind", "shirt", "--out", folder / "x.json"),
                "does not go round the chest",
            )
            bad = folder / "bad.yaml"
            bad.write_text("body:\n  bust: wide\n")
            self.check_failure(
                run("cook", skirt, "--measures", bad, "--out", folder / "x.json"), "bad.yaml", "line 2"
            )

    def test_meshes_of_others_are_worn_or_refused_by_name(self):
        garments = pathlib.Path(SHARED) / "data/field/garments"
        if not garments.exists():
            self.skipTest("no shared/data/field/garments")
        with tempfile.TemporaryDirectory() as folder:
            made = pathlib.Path(folder) / "made.json"
            suit = document(self, "cook", garments / "female_casualsuit01.obj", "--out", made, "--json")
            trousers, shirt = suit["garments"]  # the innermost first
            self.assertEqual(trousers["file"], str(made).replace("made", "made_trousers"))
            self.assertEqual(shirt["kind"], "short_sleeves")
            self.assertEqual((trousers["hangs_on"], shirt["hangs_on"]), ("waist", "shoulders"))
            for one in trousers, shirt:
                self.assertEqual((one["skin_crossings"], one["self_crossings"]), (0, 0))
            worn = run("wear", f"{trousers['file']}+{shirt['file']}", "--draft", "--out", folder)
            self.assertEqual(worn.returncode, 0, worn.stderr)
            for name, warning in (
                ("made_atorigin.obj", ""),
                ("made_bom.obj", ""),
                ("made_inch.obj", "inches (--unit in)"),
                ("made_upsidedown.obj", "upside down"),
                ("tshirt_tpose.glb", ""),
                ("longsleeve_apose.glb", "3 ends that were closed by cloth"),
            ):
                cooked = document(self, "cook", garments / name, "--out", made, "--json")
                self.assertEqual(cooked["hangs_on"], "shoulders", name)
                self.assertLessEqual({"chest", "left arm", "right arm"}, set(cooked["goes_round"]), name)
                self.assertEqual((cooked["skin_crossings"], cooked["self_crossings"]), (0, 0), name)
                self.assertIn(warning, " ".join(cooked["warnings"]), name)
            for name, reason in (("made_draco_header.glb", "Draco"), ("m_fedora.obj", "m_fedora.obj: ")):
                self.check_failure(run("cook", garments / name, "--out", made), reason)
            self.check_failure(
                run("cook", garments / "made_inch.obj", "--kind", "trousers", "--out", made),
                "made_inch.obj: ",
            )

    def test_a_mesh_is_cooked_and_worn(self):
        rows, columns = 16, 40
        lines = ["mtllib skirt.mtl", "usemtl wool"]
        for row in range(rows + 1):
            radius = 12.5 + 8 * row / rows
            for column in range(columns):
                angle = 2 * math.pi * column / columns
                x, y, z = radius * math.sin(angle), 104 - 40 * row / rows, radius * math.cos(angle)
                lines.append(f"v {x:.4f} {y:.4f} {z:.4f}")
        for row in range(rows):
            for column in range(columns):
                a, b = row * columns + column + 1, row * columns + (column + 1) % columns + 1
                lines.append(f"f {a} {a + columns} {b + columns} {b}")
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "in").mkdir()
            mesh = folder / "in" / "skirt.OBJ"
            mesh.write_text("\n".join(lines))
            found = document(self, "cook", mesh, "--out", folder / "found.json", "--json")
            self.assertIn("centimetres (--unit cm)", " ".join(found["warnings"]))
            self.check_failure(
                run("cook", mesh, "--unit", "m", "--out", folder / "skirt.json"), "skirt.OBJ", "--unit cm"
            )
            cooked = document(
                self,
                "cook",
                mesh,
                "--out",
                folder / "skirt.json",
                "--unit",
                "cm",
                "--size-label",
                "M",
                "--json",
            )
            self.assertEqual(
                (cooked["vertices"], cooked["sizes"], cooked["hangs_on"]),
                ((rows + 1) * columns, ["M"], "waist"),
            )
            self.assertEqual(len(cooked["openings_m"]), 2)
            self.assertIn("skirt.mtl", " ".join(cooked["warnings"]))
            for size in ((), ("--size", "M")):
                result = document(
                    self,
                    "fit",
                    VIRTUAL,
                    "--garment",
                    folder / "skirt.json",
                    "--draft",
                    "--frames",
                    2,
                    "--out",
                    folder / "out",
                    "--json",
                    *size,
                )
                self.assertEqual(result["cloth"]["vertices"], cooked["vertices"])
            (folder / "in" / "cut.glb").write_bytes(b"glTF")
            failed = run("cook", folder / "in", "--out", folder / "all", "--unit", "cm", "--json")
            self.assertEqual(failed.returncode, 1)
            report = json.loads(failed.stdout)
            self.assertEqual([c["garment"] for c in report["cooked"]], ["skirt"])
            self.assertIn("cut.glb", report["failed"][0]["error"])
            self.assertEqual(run("cook", mesh, "--out", folder / "x.json", "--unit", "inch").returncode, 2)

    def test_what_cannot_be_written_is_told_before_the_work(self):
        with tempfile.NamedTemporaryFile() as file:
            inside = pathlib.Path(file.name) / "x"
            self.check_failure(run("fit", VIRTUAL, "--out", inside), str(inside))
            self.check_failure(run("track", VIRTUAL, "--user-map-out", inside), str(inside))
            self.check_failure(run("track", VIRTUAL, "--pictures", inside), str(inside))
            self.check_failure(run("record", VIRTUAL, inside), str(inside))
            self.check_failure(run("plot", VIRTUAL, "--what", "depth", "--out", inside), str(inside))
        if pathlib.Path("/dev/full").exists():
            for args in (("info",), ("info", "--json"), ("track", VIRTUAL, "--json")):
                with open("/dev/full", "w") as full:
                    done = subprocess.run(
                        [VFIT, *args], stdout=full, stderr=subprocess.PIPE, text=True, timeout=300
                    )
                self.assertEqual(done.returncode, 1, args)
                self.assertIn("standard output", done.stderr)

    def test_a_name_that_is_no_utf_8_costs_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / os.fsdecode(b"r\xe9c")
            self.assertEqual(run("record", VIRTUAL, path, "--frames", 3).returncode, 0)
            plotted = document(self, "plot", path, "--what", "feet", "--out", f"{path}.png", "--json")
            self.assertIn("r\ufffdc", plotted["plot"])

    @unittest.skipUnless(pty, "no pseudo-terminals here")
    def test_long_work_shows_how_far_it_is_on_a_terminal_only(self):
        args = [
            VFIT,
            "measure",
            VIRTUAL.replace("demo", "scan").replace("frames=60", "pace=realtime"),
            "--method",
            "paper",
            "--frames",
            "60",
            "--json",
        ]
        try:
            master, terminal = pty.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminal here: {error}")
        done = subprocess.Popen(args, stdout=subprocess.PIPE, stderr=terminal)
        os.close(terminal)
        shown = b""
        try:
            while chunk := os.read(master, 4096):
                shown += chunk
        except OSError:
            pass  # Linux says EIO where the other end is closed
        os.close(master)
        self.assertEqual(json.loads(done.communicate()[0])["frames"], 60)
        self.assertRegex(shown, rb"scanning \[#+\.+\] \d+/60")
        self.assertTrue(shown.endswith(b"\r\x1b[K"), "the bar is wiped")
        self.assertEqual(run(*args[1:]).stderr, "")

    def test_wrong_usage_exits_2(self):
        for args in (
            (),
            ("dance",),
            ("measure",),
            ("measure", VIRTUAL, "--method", "guess"),
            ("measure", VIRTUAL, "--frames", "0"),
            ("size", "x.json"),
            ("measure", VIRTUAL, "--nonsense"),
            ("measure", VIRTUAL, "--joints", "sideways"),
            ("measure", VIRTUAL, "--frames", "-1"),
            ("measure", VIRTUAL, "--frames", "nan"),
            ("measure", VIRTUAL, "--frames", "99999999999"),
            ("fit", VIRTUAL, "--out", "x", "--frames", "-1"),
            ("fit", VIRTUAL, "--out", "x", "--detail", "3"),
            ("fit", VIRTUAL, "--out", "x", "--frames", "1e99"),
            ("fit", VIRTUAL),
            ("record", VIRTUAL, "x", "--frames", "0"),
            ("plot", VIRTUAL, "--what", "feet", "--out", "x", "--frames", "0"),
            ("plot", VIRTUAL, "--what", "hats", "--out", "x"),
        ):
            self.assertEqual(run(*args).returncode, 2, args)
        self.assertEqual(run("--help").returncode, 0)
        for command in ("info", "measure", "size", "track", "motion", "fit", "record", "cook", "plot"):
            self.assertEqual(run(command, "--help").returncode, 0, command)

    def test_failures_exit_1_with_one_line_that_names_the_cause(self):
        self.check_failure(run("measure", "/no/such/recording", "--json"), "/no/such/recording")
        self.check_failure(run("measure", "recording:/no/such", "--json"), "/no/such")
        self.check_failure(run("measure", "teapot:x", "--json"), "teapot", "virtual")
        self.check_failure(
            run("measure", VIRTUAL, "--garment", "spacesuit", "--json"), "spacesuit", "trousers"
        )
        self.check_failure(run("measure", VIRTUAL.replace("demo", "fly"), "--json"), "'fly'", "squat")
        self.check_failure(run("measure", VIRTUAL + "&distance=nan"), "distance")
        self.check_failure(run("measure", VIRTUAL + "&height=1e9"), "height")
        self.check_failure(run("measure", VIRTUAL.replace("60", "-3")), "frames", "'-3'")
        self.check_failure(
            run("size", "/no/file.json", "--chart", "paper", "--garment", "x"), "/no/file.json"
        )
        with tempfile.TemporaryDirectory() as folder:
            self.check_failure(run("measure", folder), "camera.json")
            self.check_failure(run("size", folder, "--chart", "paper", "--garment", "short_sleeves"), folder)
            self.check_failure(run("fit", VIRTUAL, "--garment", "toga", "--out", folder), "toga", "sundress")
            measures = pathlib.Path(folder) / "m.json"
            for text, word in (
                ("{", "JSON"),
                ('{"stature_m": "tall"}', "stature_m"),
                ('{"wingspan_m": 2}', "wingspan_m"),
                ('{"stature_m": -1}', "stature_m"),
                ('{"stature_m": 1e300}', "stature_m"),
                ('{"stature_m": null}', "stature_m"),
                ('{"stature_m": NaN}', "JSON"),
                ("[]", "object"),
                ('{"stature_m": {"sigma": 0.1}}', "stature_m"),
                ('{"measurements": 3}', "object"),
                ('{"stature_m": {"value": 1.7, "sigma": "small"}}', "sigma"),
                ('{"stature_m": {"value": 1.7, "sigma": -1}}', "sigma"),
                ("", "JSON"),
                ('{"' + "k" * 900 + '": 1}', "is no measure"),
            ):
                measures.write_text(text)
                self.check_failure(
                    run("size", measures, "--chart", "paper", "--garment", "short_sleeves"), word
                )
            measures.write_text('{"stature_m": 1.7}')
            self.check_failure(
                run("size", measures, "--chart", "nowhere", "--garment", "x"), "nowhere", "paper"
            )
            gone = pathlib.Path(folder) / "gone.json"
            self.check_failure(run("size", measures, "--chart", gone, "--garment", "x"), str(gone))
            chart = pathlib.Path(folder) / "chart.json"
            chart.write_text(
                '{"format": "vfit-size-chart", "version": 1, "name": "x", "unit": "cm", "garments": ['
                '{"kind": "dress", "measures": ["stature_m"], "sizes": ['
                '{"label": "S", "ranges": {"stature_m": [150, 170]}}, '
                '{"label": "M", "ranges": {"stature_m": [140, 180]}}]}]}'
            )
            self.check_failure(
                run("size", measures, "--chart", chart, "--garment", "dress"), "dress", "M", str(chart)
            )


class PaperSample(unittest.TestCase):
    PROGRAM = pathlib.Path(VFIT).with_name("vfit-paper")

    def run_paper(self, *args):
        return run_program(self.PROGRAM, *args)

    def test_the_tables_have_the_papers_people_and_ours(self):
        done = self.run_paper("tables")
        self.assertEqual(done.returncode, 0, done.stderr)
        for table in ("Table 1.", "Table 2.", "Table 3.", "Table 4."):
            self.assertIn(table, done.stdout)
        table_3 = done.stdout[done.stdout.index("Table 3.") : done.stdout.index("Table 4.")]
        _, _, fitted = table_3.partition("  fitted body ")
        subjects = [line.split() for line in fitted.splitlines() if line.strip()[:1].isdigit()]
        self.assertEqual([s[0] for s in subjects], [str(n) for n in range(1, 8)])
        for number, real, told, error, *_ in subjects:
            self.assertAlmostEqual(
                100 * abs(float(told) / float(real) - 1), float(error), delta=0.3, msg=number
            )
            self.assertLess(float(error), 5, f"shoulders of subject {number}")

    def test_the_figures_are_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_paper("figures", "--out", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            for name in ("fig_4.png", "fig_8.png", "fig_9.png"):
                width, height, rgb = picture(pathlib.Path(folder) / name)
                self.assertGreater(min(width, height), 200, name)
                self.assertGreater(len(set(rgb)), 10, name)

    def test_the_forearm_keeps_its_volume_and_the_curves_are_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_paper("motion", "--source", VIRTUAL, "--feet", VIRTUAL, "--out", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            kept = {
                line.split(":")[0].strip(): float(line.split(": ", 1)[1].split()[0])
                for line in done.stdout.splitlines()
                if line.startswith("  (")
            }
            self.assertEqual(list(kept), ["(a) one bone", "(b) two bones", "(c) vfit's seven"])
            self.assertGreater(kept["(c) vfit's seven"], 98)
            for name in ("fig_5.png", "fig_6.png", "fig_7.png", "fig_11.png"):
                width, height, rgb = picture(pathlib.Path(folder) / name)
                self.assertGreater(min(width, height), 200, name)
                self.assertGreater(len(set(rgb)), 10, name)

    def test_the_outfits_are_drawn_in_draft_and_none_is_torn(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_paper("garments", "--draft", "--out", folder, "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            for number in (2, 12, 13, 14, 15):
                width, height, rgb = picture(pathlib.Path(folder) / f"fig_{number}.png")
                self.assertGreater(min(width, height), 200, number)
                self.assertGreater(len(set(rgb)), 10, number)
            report = json.loads(done.stdout)
            outfits = {**report["fig_14"]["female"], **report["fig_14"]["male"]}
            self.assertEqual(
                list(outfits),
                ["sundress", "duster", "jeans and vest", "flight suit", "pants and shirt", "martial suit"],
            )
            for person in (*report["fig_14"].values(), *report["fig_15"].values()):
                for outfit, garments in person.items():
                    for name, how in garments.items():
                        self.assertLess(how["strain_p99"], 0.3, f"{name} of {outfit}")
                        self.assertLess(
                            how["strain_max"], 4.0, f"{name} of {outfit}: caught on what is below"
                        )
                        self.assertLess(how["sank_m"], 0.02, f"{name} of {outfit}: it slides down")

    def test_the_frame_rate_is_told_by_phase(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_paper(
                "rates", "--not-drawn", "--garment", "sundress", "--seconds", "0.6", "--out", folder, "--json"
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            (way,) = json.loads(done.stdout)
            phases = way["garments"]["sundress"]
            self.assertEqual(
                [p["phase"] for p in phases], ["static", "sensor on", "physics off", "sensor off"]
            )
            for p in phases:
                self.assertGreater(p["frames"], 10, p["phase"])
                self.assertLessEqual(p["frame_ms"]["median"], p["frame_ms"]["p95"], p["phase"])
            self.assertEqual([p["cloth_steps"] > 0 for p in phases], [True, True, False, False])
            for p in phases[:2]:
                self.assertGreaterEqual(
                    p["cloth_interval_ms"]["median"], 8.0, "the paper's pause between two steps"
                )
            width, height, rgb = picture(pathlib.Path(folder) / "fig_10_not_drawn.png")
            self.assertGreater(len(set(rgb)), 10)

    def test_table_5_counts_what_is_simulated(self):
        started = time.monotonic()
        done = self.run_paper("meshes", "--frames", "8", "--json")
        wall_ms = 1e3 * (time.monotonic() - started)
        self.assertEqual(done.returncode, 0, done.stderr)
        meshes = json.loads(done.stdout)["meshes"]
        self.assertEqual(
            (meshes["sundress"]["skinned_vertices"], meshes["sundress"]["simulated_vertices"]),
            (1048, 3096),
            "as the paper's",
        )
        self.assertEqual(meshes["sundress, Meng's size"]["simulated_vertices"], 2400)
        timed = {name: mesh for name, mesh in meshes.items() if "step_ms" in mesh}
        for name, mesh in timed.items():
            built = GARMENTS / f"{name}.json"
            if built.exists():
                simulated = sum(json.loads(built.read_text())["simulated"])
                self.assertEqual(mesh["simulated_vertices"], simulated, name)
            for what in ("step_ms", "step_on_skin_ms", "frame_ms"):
                self.assertEqual(mesh[what]["n"], 7, f"{name}: the first of 8 frames puts it on")
                self.assertGreaterEqual(mesh[what]["p95"], mesh[what]["median"], name)
            self.assertGreater(mesh["frame_ms"]["median"], mesh["step_ms"]["median"], "a frame holds a step")
        self.assertEqual(len(timed.keys() & {file.stem for file in GARMENTS.glob("*.json")}), 10)
        # Four of seven samples are at least the median.
        spent_ms = sum(
            4 * m[what]["median"] for m in timed.values() for what in ("frame_ms", "step_on_skin_ms")
        )
        self.assertLess(spent_ms, wall_ms)

    def test_programs_that_the_path_finds_find_their_data(self):
        bench = pathlib.Path(VFIT).with_name("vfit-bench").resolve()
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [bench.name, "population", "--count", "1"],
                cwd=folder,
                capture_output=True,
                text=True,
                env={**os.environ, "PATH": f"{bench.parent}:{os.environ['PATH']}"},
                timeout=100,
            )
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_is_not_there_is_named(self):
        done = self.run_paper("figures", "--source", "/no/recording")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/no/recording", done.stderr)


@unittest.skipUnless(RECORDINGS, f"real recordings are not at {SHARED}")
class RealRecordings(unittest.TestCase):
    def test_every_recording_is_measured_and_dressed(self):
        fitted = []
        for recording in RECORDINGS:
            with self.subTest(recording.name), tempfile.TemporaryDirectory() as folder:
                measured = document(self, "measure", recording, "--method", "paper", "--json")
                self.assertGreaterEqual(measured["frames"], 10)
                stature_m = measured["measurements"]["stature_m"]["value"]
                self.assertTrue(1.4 < stature_m < 2.1)
                # A body is fitted where arms are clear of it; not all of these people hold them so.
                told = document(self, "measure", recording, "--json")
                told_m = told["measurements"]["stature_m"]["value"]
                if told["method"] == "fit":
                    fitted.append(recording.name)
                    self.assertNotIn("note", told)
                    self.assertAlmostEqual(told_m, stature_m, delta=0.06)
                else:
                    self.assertEqual((told["method"], told_m), ("paper", stature_m))
                    self.assertRegex(told["note"], "paper's method.*no frame could be used.*arms")
                    refused = run("measure", recording, "--method", "fit")
                    self.assertEqual(refused.returncode, 1)
                    self.assertRegex(refused.stderr, "no frame could be used.*arms")
                result = document(self, "fit", recording, "--draft", "--frames", 6, "--out", folder, "--json")
                self.assertEqual(result["method"], told["method"])
                self.assertTrue(all(garment["sizes"] for garment in result["garments"]))
                self.assertTrue(all(math.isfinite(x) for x in numbers(result)))
        self.assertGreaterEqual(len(fitted), len(RECORDINGS) * 3 // 4)

    def test_real_people_are_tracked_from_depth_alone(self):
        """Against the joints of the recordings' own middleware, whose definitions differ by up to 10 cm."""
        for path in RECORDINGS:
            given, found = (
                lines(self, "track", path, "--json"),
                lines(self, "track", path, "--joints", "tracked", "--json"),
            )
            errors = []
            for f, g in zip(found, given):
                self.assertEqual(len(f["bodies"]), 1, path)
                joints, reference = f["bodies"][0]["joints"], g["bodies"][0]["joints"]
                errors += [math.dist(joints[n][:3], reference[n][:3]) for n in reference if n in joints]
            self.assertLess(statistics.median(errors), 0.08, path)

    def test_motion_of_every_recording_is_finite(self):
        for recording in RECORDINGS:
            with self.subTest(recording.name):
                frames = lines(self, "motion", recording, "--json")
                self.assertEqual(len(frames), len(list((recording / "depth").glob("*.png"))))
                self.assertTrue(all(math.isfinite(x) for f in frames for x in numbers(f)))

    def test_a_hand_that_hooks_behind_a_skirt_lets_it_go(self):
        recording = next(r for r in RECORDINGS if "s1_walking" in r.name)
        with tempfile.TemporaryDirectory() as folder:
            dressed = ("--garment", "sundress", "--sex", "f")
            result = document(self, "fit", recording, *dressed, "--draft", "--out", folder, "--json")
        self.assertLess(result["worst_strain"]["strain"], 1.0, "held by the hand it comes to 4 or more")
        self.assertFalse(result["torn"])

    def test_a_cut_picture_ends_with_its_name(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "rec"
            shutil.copytree(RECORDINGS[0], copy)
            picture = copy / "depth" / "000003.png"
            picture.chmod(0o644)
            picture.write_bytes(picture.read_bytes()[:200])
            done = run("track", copy, "--json")
            self.assertEqual(done.returncode, 1)
            self.assertIn("000003.png", done.stderr)
            self.assertEqual(len(done.stdout.splitlines()), 3, "frames before the cut one are printed")


class Report(unittest.TextTestResult):
    """Keeps what passes, too."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.passed = []

    def addSuccess(self, test):
        super().addSuccess(test)
        self.passed.append((test, ""))

    def write(self, path):
        def named(tests):
            return [
                {"name": test.id().removeprefix("__main__."), "reason": str(reason)} for test, reason in tests
            ]

        report = {
            "passed": named(self.passed),
            "failed": named(self.failures + self.errors),
            "skipped": named(self.skipped),
        }
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(report, indent=2))


if __name__ == "__main__":
    classes = sys.argv[3:]
    runner = unittest.TextTestRunner(verbosity=2, resultclass=Report)
    result = unittest.main(argv=sys.argv[:1] + classes, testRunner=runner, exit=False).result
    if folder := os.environ.get("VFIT_TEST_REPORTS"):
        result.write(pathlib.Path(folder) / f"chain_{'_'.join(classes) or 'all'}.json")
    sys.exit(not result.wasSuccessful())
