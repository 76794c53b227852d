"""Scans of other makers become recordings and tables that `vfit validate` reads."""

import contextlib
import csv
import importlib.util
import io
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "import_scans" / "__main__.py"
SHARED = Path(os.environ.get("VFIT_SHARED", ROOT.parent / "shared"))
RECORDING = SHARED / "data" / "recordings" / "kinect1_s1_front_clap_1"
VFIT = Path(os.environ.get("VFIT_BUILD_DIR", ROOT / "build")) / "bin" / "vfit"

spec = importlib.util.spec_from_file_location("import_scans", TOOL)
tool = importlib.util.module_from_spec(spec)
spec.loader.exec_module(tool)

XML = """<?xml version="1.0" encoding="utf-8"?>
<texel>
  <person gender="female"><name>NA</name><group>adult</group></person>
  <scan scanner="free_fusion" date="2025-01-02T03:04:05Z">
    <person><age>35</age><weight>58</weight><height>178</height></person>
    <tags><hairstyle>shaved</hairstyle><clothing>underwear</clothing><shoes>barefoot</shoes></tags>
    <stage pass="head"><bounding_box/><stream sensor="azure_kinect" sensor_data="">
      <depth path="head" width="320" height="240"/></stream></stage>
    <stage pass="body">
      <bounding_box min_x="-1" min_y="-1" min_z="1" max_x="1" max_y="1" max_z="3"/>
      <stream sensor="azure_kinect" sensor_data="">
        <depth path="frames" width="320" height="240">
          <intrinsics cx="159.0" cy="120.0" fx="285.63" fy="285.63"/>
          <extrinsics rot11="1" rot12="0" rot13="0" rot21="0" rot22="1" rot23="0" rot31="0" rot32="0"
                      rot33="1" trans1="0" trans2="0" trans3="0"/>
        </depth>
      </stream>
    </stage>
  </scan>
</texel>
"""
# Identifier, name, clause, value in cm; a byte order mark and a value left out, as the scanner writes them.
SHEET = """\ufeffID,Name,ISO 8559-1,Value
m12,Height,5.1.1,171.2
m5,Bust/Chest Girth,5.3.4,90.5
m16,Waist Girth,5.3.10,75.0
m102,Minimum Waist Girth,,73.1
m15_l,Upper Arm Girth (L),5.3.16,28.0
m15_r,Upper Arm Girth (R),5.3.16,29.0
m44,Bust Girth Contoured,5.3.5,93.0
m13,Hip Girth,5.3.13,
"""
TC2 = """OPTION UNITS=cm
MEASURE Head_Top_Height=165.4
MEASURE BUST_Circ=95.2
MEASURE NeckBase_Circ=40.0
MEASURE HIP_Circ=101.5
"""


class ImportScansTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.source, self.out = Path(folder.name) / "source", Path(folder.name) / "out"
        self.source.mkdir()

    def texel(self, name="Woman1", xml=XML, sheet=SHEET, images=2):
        person = self.source / "Part1" / name
        (person / "frames").mkdir(parents=True)
        for i in range(images):
            (person / "frames" / f"depth_{i:04d}.png").write_bytes(b"image %d" % i)
        (person / "person.scan.xml").write_text(xml)
        if sheet:
            (person / "portal_mx").mkdir()
            (person / "portal_mx" / "measurements.csv").write_text(sheet, encoding="utf-8")
        return person

    def run_tool(self, *arguments):
        errors, words = io.StringIO(), io.StringIO()
        with (
            mock.patch.object(sys, "argv", ["import_scans", str(self.source), str(self.out), *arguments]),
            contextlib.redirect_stderr(errors),
            contextlib.redirect_stdout(words),
        ):
            code = tool.main()
        return code, errors.getvalue()

    def table(self):
        with open(self.out / "tapes.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_a_texel_scan_is_a_recording_with_measures(self):
        self.texel()
        self.assertEqual(self.run_tool("--fps", "15"), (0, ""))
        self.assertEqual(
            self.table(),
            [
                {
                    "scan": "Part1-Woman1",
                    "person": "Part1-Woman1",
                    "sex": "f",
                    "bare": "yes",
                    "tight": "yes",
                    "turn": "yes",
                }
            ],
        )
        folder = self.out / "Part1-Woman1"
        camera = json.loads((folder / "camera.json").read_text())
        told = tuple(camera[name] for name in ("width", "fx", "cy", "fps"))
        self.assertEqual(told, (320, 285.63, 120.0, 15))
        self.assertEqual((folder / "depth/000001.png").read_bytes(), b"image 1")
        measures = json.loads((folder / "measures.json").read_text())
        self.assertEqual(
            {key: round(value, 4) for key, value in measures.items()},
            {
                "stature_m": 1.712,
                "chest_girth_m": 0.905,
                "waist_girth_m": 0.75,
                "waist_minimum_girth_m": 0.731,
                "upper_arm_girth_m": 0.285,
            },
        )

    def test_tc2_sheets_have_units(self):
        (self.source / "female_0003.txt").write_text(TC2)
        (self.source / "male_0001.txt").write_text(TC2.replace("cm", "in"))
        code, errors = self.run_tool()
        self.assertEqual(code, 1)
        self.assertRegex(errors, "male_0001.txt: a stature of 4.2.* m is not plausible")
        (row,) = self.table()
        self.assertEqual((row["person"], row["sex"]), ("female_0003", "f"))
        measures = json.loads((self.out / "female_0003/measures.json").read_text())
        self.assertEqual(sorted(measures), ["chest_girth_m", "hip_girth_m", "stature_m"])
        self.assertAlmostEqual(measures["chest_girth_m"], 0.952)

    def test_what_cannot_be_read_is_named(self):
        cases = [
            (XML.replace("texel>", "model>"), "outermost element is <model>"),
            (XML[:300], "is no XML"),
            (XML.replace(' fx="285.63"', ""), "the camera lacks one of fx, fy, cx, cy"),
            (XML.replace('path="frames"', 'path="nowhere"'), "nowhere holds no depth image"),
            (XML.replace('pass="body"', 'pass="head"'), "no depth stream of a whole body"),
            (XML.replace('width="320"', 'width="-5"'), "images of -5 by 240 pixels"),
            (XML.replace('width="320"', 'width="320.5"'), "images of 320.5 by 240 pixels"),
            (XML.replace('fx="285.63"', 'fx="-1"'), "a focal length of -1 pixels"),
            (XML.replace('fy="285.63"', 'fy="nan"'), "the camera lacks one of"),
        ]
        for i, (xml, _) in enumerate(cases):
            self.texel(f"Man{i}", xml=xml)
        self.texel("Man9", sheet="ID,Name,Clause,Value\nm1,Across Back,5.4.3,40\n")
        for name, value in (("Man10", "inf"), ("Man11", "-75.0"), ("Man12", "7500")):
            self.texel(name, sheet=SHEET.replace("75.0", value))
        self.texel("Woman9")
        code, errors = self.run_tool()
        for name in ("Man10", "Man11", "Man12"):
            self.assertRegex(errors, f"{name}/.*: waist_girth_m of .* m is not plausible")
        self.assertEqual(code, 1)
        for i, (_, words) in enumerate(cases):
            self.assertRegex(errors, f"Man{i}/person.scan.xml: .*{words}")
        self.assertRegex(errors, "Man9/.*measurements.csv: holds no measure by a clause")
        self.assertEqual([row["person"] for row in self.table()], ["Part1-Woman9"])

    def test_sheets_in_other_encodings_are_read(self):
        person = self.texel(sheet="")
        (person / "portal_mx").mkdir()
        sheet = "ID,Name,Clause,Value\nm12,K\u00f6rperh\u00f6he\0,5.1.1,170.0\nm16,Taille,5.3.10,nan\n"
        (person / "portal_mx" / "measurements.csv").write_bytes(sheet.encode("latin-1"))
        self.assertEqual(self.run_tool(), (0, ""))
        measures = json.loads((self.out / "Part1-Woman1/measures.json").read_text())
        self.assertEqual(measures, {"stature_m": 1.7})

    def test_options_are_numbers_above_zero(self):
        self.texel()
        for option in ("--fps", "--depth-unit"):
            for value in ("0", "-1", "nan", "inf"):
                with self.assertRaises(SystemExit):
                    self.run_tool(option, value)

    def test_nothing_is_written_over(self):
        self.texel()
        self.run_tool()
        with self.assertRaisesRegex(SystemExit, "holds tapes.csv already"):
            self.run_tool()
        self.source, self.out = self.out, self.out / "again"
        with self.assertRaisesRegex(SystemExit, "holds neither"):
            self.run_tool()

    @unittest.skipUnless(RECORDING.is_dir(), "the recordings are not there")
    def test_vfit_validates_what_was_imported(self):
        xml = XML.replace("female", "male").replace("shaved", "long_haircut")
        person = self.texel("Man1", xml=xml, images=0, sheet=SHEET.replace("171.2", "175.0"))
        for image in sorted((RECORDING / "depth").glob("*.png"))[:80]:
            (person / "frames" / image.name).write_bytes(image.read_bytes())
        self.assertEqual(self.run_tool(), (0, ""))
        done = subprocess.run([VFIT, "validate", self.out, "--json"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        result = json.loads(done.stdout)
        self.assertEqual((result["scans"], result["failed"]), (1, []))
        self.assertEqual(result["measures"]["waist_girth_m"]["people"], 1)
        # A man of about 1.75 m; that of another person would be off by more.
        self.assertLess(abs(result["measures"]["stature_m"]["bias"]), 0.1)
        done = subprocess.run([VFIT, "validate", self.source], capture_output=True, text=True)
        self.assertRegex(done.stderr, "import_scans")


if __name__ == "__main__":
    unittest.main()
