"""Makes recordings and measures of vfit from what other scanners wrote, for `vfit validate`.

    python3 tools/import_scans SOURCE OUT [--scanner free_fusion] [--fps 30] [--depth-unit 0.001]
    build/bin/vfit validate OUT

SOURCE is one of:
- a folder of the Texel-BodyScan-Dataset: people who turn round before an Azure Kinect (PERSON/*.scan.xml and
  depth images), with measurements.csv of a body scanner by the clauses of ISO 8559-1;
- a folder of sheets of a [TC]2 scanner, as those of NOMO-3D-400: one text file a person, MEASURE Name=value.

OUT gets a folder for each recording and tapes.csv. Depth images are linked where the file system allows, else
copied. docs/tape.md says which measure becomes which.
"""

import argparse
import csv
import json
import os
import re
import shutil
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

# Clauses of ISO 8559-1:2017 whose measures vfit has, and one that the standard lacks, by its name.
CLAUSES = {
    "5.1.1": "stature_m",
    "5.1.15": "inside_leg_m",
    "5.3.2": "neck_girth_m",
    "5.3.4": "chest_girth_m",
    "5.3.8": "underbust_girth_m",
    "5.3.10": "waist_girth_m",
    "5.3.13": "hip_girth_m",
    "5.3.16": "upper_arm_girth_m",
    "5.3.20": "thigh_girth_m",
    "5.7.8": "arm_length_m",
}
NAMES = {"minimum waist girth": "waist_minimum_girth_m"}
TC2 = {
    "Head_Top_Height": "stature_m",
    "BUST_Circ": "chest_girth_m",
    "CHEST_Circ": "chest_girth_m",
    "NaturalWAIST_Circ": "waist_girth_m",
    "HIP_Circ": "hip_girth_m",
    "Neck_Circ": "neck_girth_m",
    "Thigh_Circ": "thigh_girth_m",
    "Bicep_Circ": "upper_arm_girth_m",
    "Inseam": "inside_leg_m",
}
UNITS = {"mm": 0.001, "cm": 0.01, "m": 1.0, "in": 0.0254, "inch": 0.0254, "inches": 0.0254}
SEX = {"female": "f", "male": "m"}
BARE = ("barefoot", "shaved")  # shoes and hair
PLAUSIBLE_STATURE_M = (0.9, 2.4)
LARGEST_M = 4.0  # of any measure
LARGEST_IMAGE = 16384  # pixels, as recordings have it


class Refused(Exception):
    """What is wrong with a file, for the person at the keyboard."""


def plausible(path, measures):
    for key, value in sorted(measures.items(), key=lambda one: one[0] != "stature_m"):
        low, high = PLAUSIBLE_STATURE_M if key == "stature_m" else (0.0, LARGEST_M)
        if not low < value < high:
            name = "a stature" if key == "stature_m" else key
            raise Refused(f"{path}: {name} of {value:g} m is not plausible: is the unit another one?")
    return measures


def texel_measures(path):
    """Measures of a Texel scanner: rows of identifier, name and clause in either order, and centimetres."""
    sides = {}
    with open(path, newline="", encoding="utf-8-sig", errors="replace") as file:
        for row in csv.reader(line.replace("\0", "") for line in file):
            if len(row) < 4:
                continue
            try:
                value = float(row[3]) * UNITS["cm"]
            except ValueError:
                continue  # the head of the table, or a value that was left out
            words = [cell.strip() for cell in row[1:3]]
            clause = next((c for cell in words for c in re.findall(r"\b5\.\d+\.\d+\b", cell)), None)
            key = CLAUSES.get(clause) or next((NAMES[w.lower()] for w in words if w.lower() in NAMES), None)
            if key and (value > 0 or value < 0):  # 0 and NaN: left out
                sides.setdefault(key, []).append(value)
    if not sides:
        raise Refused(f"{path}: holds no measure by a clause of ISO 8559-1 that vfit has")
    # Left and right have a row each; vfit's limbs are the mean of both.
    return plausible(path, {key: sum(values) / len(values) for key, values in sides.items()})


def tc2_measures(path):
    unit, values = None, {}
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        word, _, rest = line.strip().partition(" ")
        name, _, value = rest.partition("=")
        if word == "OPTION" and name.strip() == "UNITS":
            unit = UNITS.get(value.strip().lower())
            if unit is None:
                raise Refused(f"{path}: the unit '{value.strip()}' is none of {', '.join(UNITS)}")
        elif word == "MEASURE" and name.strip() in TC2:
            try:
                values[TC2[name.strip()]] = float(value)
            except ValueError:
                raise Refused(f"{path}: {name.strip()} has no number: '{value.strip()}'") from None
    if unit is None:
        raise Refused(f"{path}: no line OPTION UNITS=... says the unit")
    if not values:
        raise Refused(f"{path}: no line MEASURE ... holds a measure that vfit has")
    return plausible(path, {key: value * unit for key, value in values.items() if value})


def numbers(element, names, path):
    try:
        values = [float(element.get(name)) for name in names]
    except (AttributeError, TypeError, ValueError):
        values = [float("nan")]
    if not all(abs(value) < float("inf") for value in values):
        raise Refused(f"{path}: the camera lacks one of {', '.join(names)}")
    return values


def place(image, where):
    try:
        os.link(image, where)
    except OSError:
        shutil.copyfile(image, where)


def write_recording(depth, xml, folder, options):
    """The camera and the images of one <depth>."""
    width, height = numbers(depth, ("width", "height"), xml)
    fx, fy, cx, cy = numbers(depth.find("intrinsics"), ("fx", "fy", "cx", "cy"), xml)
    if not all(size == int(size) and 0 < size <= LARGEST_IMAGE for size in (width, height)):
        raise Refused(f"{xml}: images of {width:g} by {height:g} pixels: each is 1 to {LARGEST_IMAGE}")
    if not (fx > 0 and fy > 0):
        raise Refused(f"{xml}: a focal length of {min(fx, fy):g} pixels is not above 0")
    images = sorted((xml.parent / depth.get("path", "")).glob("*.png"))
    if not images:
        raise Refused(f"{xml}: {depth.get('path')} holds no depth image (*.png)")
    (folder / "depth").mkdir(parents=True)
    for i, image in enumerate(images):
        place(image, folder / f"depth/{i:06d}.png")
    camera = {
        "format": "vfit-recording",
        "version": 1,
        "sensor": "azure_kinect",
        "width": int(width),
        "height": int(height),
        "fx": fx,
        "fy": fy,
        "cx": cx,
        "cy": cy,
        "fps": options.fps,
        "depth_unit_m": options.depth_unit,
    }
    (folder / "camera.json").write_text(json.dumps(camera, indent=1) + "\n")


def import_texel(xml, out, options):
    """Rows of tapes.csv, one for each recording of the whole body."""
    try:
        root = ElementTree.parse(xml).getroot()
    except ElementTree.ParseError as error:
        raise Refused(f"{xml}: is no XML: {error}") from None
    if root.tag != "texel":
        raise Refused(f"{xml}: the outermost element is <{root.tag}>, not <texel>")
    person = root.find("person")
    sheet = xml.parent / options.scanner / "measurements.csv"
    measures = texel_measures(sheet) if sheet.exists() else {}
    rows = []
    for scan in root.findall("scan"):
        tag = {e.tag: (e.text or "").strip() for e in scan.iterfind("tags/*")}
        for depth in scan.iterfind("stage[@pass='body']/stream/depth"):
            name = "-".join(xml.parent.relative_to(options.source).parts) or xml.name.split(".")[0]
            folder = out / (name if not rows else f"{name}-{len(rows) + 1}")
            if folder.exists():
                raise Refused(f"{folder}: is there already")
            write_recording(depth, xml, folder, options)
            if measures:
                (folder / "measures.json").write_text(json.dumps(measures, indent=1) + "\n")
            rows.append(
                {
                    "scan": folder.name,
                    "person": name,
                    "sex": SEX.get(person.get("gender"), "") if person is not None else "",
                    "bare": "yes" if (tag.get("shoes"), tag.get("hairstyle")) == BARE else "",
                    "tight": "yes" if tag.get("clothing") in ("underwear", "tight") else "",
                    "turn": "yes",
                }
            )
    if not rows:
        raise Refused(f"{xml}: holds no depth stream of a whole body")
    return rows


def import_tc2(sheet, out, options):
    sex = next((SEX[word] for word in re.split(r"[^a-z]+", sheet.stem.lower()) if word in SEX), "")
    folder = out / sheet.stem
    if folder.exists():
        raise Refused(f"{folder}: is there already")
    measures = tc2_measures(sheet)
    folder.mkdir(parents=True)
    (folder / "measures.json").write_text(json.dumps(measures, indent=1) + "\n")
    return [{"scan": folder.name, "person": sheet.stem, "sex": sex, "bare": "", "tight": "", "turn": ""}]


def above_zero(text):
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a number above 0")
    return value


COLUMNS = ("scan", "person", "sex", "bare", "tight", "turn")
FORMATS = {"*.scan.xml": import_texel, "*.txt": import_tc2}


def main():
    parser = argparse.ArgumentParser(
        prog="import_scans", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("source", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument(
        "--scanner",
        default="portal_mx",
        help="whose measurements.csv is the truth (portal_mx; free_fusion is made of the same depth images)",
    )
    parser.add_argument("--fps", type=above_zero, default=30.0, help="depth images a second")
    parser.add_argument("--depth-unit", type=above_zero, default=0.001, help="metres of one depth step")
    options = parser.parse_args()
    for pattern, read in FORMATS.items():
        files = sorted(options.source.rglob(pattern))
        if files:
            break
    else:
        raise SystemExit(f"import_scans: {options.source}: holds neither {' nor '.join(FORMATS)}")
    if (options.out / "tapes.csv").exists():
        raise SystemExit(f"import_scans: {options.out}: holds tapes.csv already")
    rows, refused = [], 0
    for file in files:
        try:
            rows += read(file, options.out, options)
        except Refused as reason:
            refused += 1
            print(f"import_scans: {reason}", file=sys.stderr)
    if rows:
        with open(options.out / "tapes.csv", "w", newline="") as file:
            table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            table.writeheader()
            table.writerows(rows)
    print(f"import_scans: {len(rows)} scans in {options.out}, {refused} files refused")
    return 1 if refused or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
