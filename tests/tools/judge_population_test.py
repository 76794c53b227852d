"""The judge of populations reads published tables in metres and counts errors."""

import contextlib
import importlib.util
import io
import tempfile
import unittest
from collections import namedtuple
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
spec = importlib.util.spec_from_file_location("judge_population", ROOT / "tools/judge_population/__main__.py")
judge = importlib.util.module_from_spec(spec)
spec.loader.exec_module(judge)

Measurement = namedtuple("Measurement", "value sigma")


class JudgePopulationTest(unittest.TestCase):
    def read(self, text, sex=None):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "table.csv"
            path.write_text(text)
            return judge.read_table(path, sex)

    def test_published_tables_are_read_in_metres(self):
        (man,) = self.read(
            "Density,Age,Weight,Height,Chest,Abdomen,Hip\r\n1.07,23,154.25,67.75,93.1,85.2,94.5\r\n"
        )
        self.assertEqual(man["sex"], "m")
        self.assertAlmostEqual(man["stature_m"], 1.72085)
        self.assertAlmostEqual(man["body_mass_kg"], 69.97, 2)
        self.assertAlmostEqual(man["waist_navel_girth_m"], 0.852)
        woman, other = self.read(
            "che.gi,wai.gi,nav.gi,hip.gi,age,wgt,hgt,sex\n80,65,75,92,22,55,165,0\n100,85,88,98,30,80,180,1\n"
        )
        self.assertEqual((woman["sex"], other["sex"]), ("f", "m"))
        self.assertAlmostEqual(woman["waist_minimum_girth_m"], 0.65)
        (one,) = self.read("# a survey\nBMXWT,BMXHT,BMXHIP,BMXWAIST\n70,170,100,\n", "f")
        self.assertNotIn("waist_navel_girth_m", one)

    def test_a_table_of_ones_own_has_keys(self):
        people = self.read("id,sex,stature_m,body_mass_kg,hip_girth_m\n7,f,1.7,60,1.0\n8,f,0.75,60,1.0\n")
        self.assertEqual(people, [{"sex": "f", "stature_m": 1.7, "body_mass_kg": 60.0, "hip_girth_m": 1.0}])

    def test_what_is_no_table_is_refused(self):
        for text in ("", "a,b\n1,2\n", "stature_m,body_mass_kg\n1.7,60\n"):
            with self.assertRaises(SystemExit):
                self.read(text)

    def test_slips_are_made_and_counted(self):
        person = {
            "sex": "f",
            "stature_m": 1.7,
            "body_mass_kg": 60.0,
            "chest_girth_m": 0.9,
            "hip_girth_m": 1.0,
        }
        Doubt = namedtuple("Doubt", "key suggested other_key")

        def check(known, sex):  # finds what changed, and nothing else
            return [Doubt(key, person[key], "") for key in known if known[key] != person[key]]

        with contextlib.redirect_stdout(io.StringIO()):
            alarms, found = judge.report_slips("women", [person], check)
            self.assertEqual((alarms, set(found.values())), (0.0, {1.0}))
            self.assertEqual(judge.report_slips("women", [person], lambda known, sex: [])[1]["swapped"], 0.0)
            self.assertIsNone(judge.report_slips("short lists", [{"sex": "f", "hip_girth_m": 1.0}], check))

    def test_errors_are_counted(self):
        people = [{"sex": "f", "stature_m": 1.7, "hip_girth_m": hip} for hip in (0.98, 1.0, 1.05)]
        told = []

        def estimate(known, sex, age):
            told.append((known, sex, age))
            return {"hip_girth_m": Measurement(1.0, 0.02)}

        with contextlib.redirect_stdout(io.StringIO()) as out:
            judge.report("women", people, estimate, ("stature_m",))
        self.assertEqual(told[0], ({"stature_m": 1.7}, "f", None))
        self.assertIn("23 mm, mean error   -10, within 90 %: 67 %", out.getvalue())


if __name__ == "__main__":
    unittest.main()
