#!/usr/bin/env python3
"""Fits assets/populations/adults.json: how the measures of adults go together, by sex (README.md).

python3 training/population/fit.py --soldiers ANSUR --civilians NHANES.txt --bodies people.json --out FILE
"""

import argparse
import csv
import gzip
import json
import math
import pathlib
import re

import numpy

# Key: column of ANSUR II in millimetres, and what of it is the body's, for women and men. The survey's upper
# arm is flexed; its breadths and depths are by caliper, which presses flesh, and its chest breadth leaves out
# the muscles behind the armpits (tools/population/population.cpp).
SOLDIERS = {
    "stature_m": ("stature", 1.0, 1.0),
    "body_mass_kg": ("weightkg", 100.0, 100.0),  # tenths of a kilogram
    "waist_navel_girth_m": ("waistcircumference", 1.0, 1.0),
    "hip_girth_m": ("buttockcircumference", 1.0, 1.0),
    "chest_girth_m": ("chestcircumference", 1.0, 1.0),
    "neck_girth_m": ("neckcircumference", 1.0, 1.0),
    "thigh_girth_m": ("thighcircumference", 1.0, 1.0),
    "upper_arm_girth_m": ("bicepscircumferenceflexed", 0.93, 0.93),
    "inside_leg_m": ("crotchheight", 1.0, 1.0),
    "arm_length_m": ("sleeveoutseam", 1.0, 1.0),
    "shoulder_breadth_m": ("bideltoidbreadth", 1.0, 1.0),
    "biacromial_breadth_m": ("biacromialbreadth", 1.0, 1.0),
    "elbow_fingertip_m": ("forearmhandlength", 1.0, 1.0),
    "hand_length_m": ("handlength", 1.0, 1.0),
    "head_width_m": ("headbreadth", 1.0, 1.0),
    "chest_breadth_m": ("chestbreadth", 1.15, 1.19),
    "chest_depth_m": ("chestdepth", 1.01, 1.06),
    "hip_breadth_m": ("hipbreadth", 1.04, 1.04),
    "hip_depth_m": ("buttockdepth", 1.04, 1.04),
}
# What both surveys have. The civilians' waist is at the top of the iliac crest, close to the navel.
BASE = ["age_years", "stature_m", "body_mass_kg", "waist_navel_girth_m", "hip_girth_m"]
CIVILIANS = {
    "stature_m": ("HeightCm", 0.01),
    "body_mass_kg": ("WeightKg", 1.0),
    "waist_navel_girth_m": ("WaistCm", 0.01),
    "hip_girth_m": ("HipCm", 0.01),
}
# What no survey has is taken from generated bodies, by these of their measures. Their waist at the navel, at
# the level of the person's own, is "navel_girth_m".
OF_BODIES = [
    "waist_girth_m",
    "waist_minimum_girth_m",
    "underbust_girth_m",
    "waist_breadth_m",
    "waist_depth_m",
    "torso_height_m",
    "hip_height_m",
    "head_height_m",
]
KNOWN_OF_BODIES = [
    "stature_m",
    "waist_navel_girth_m",
    "hip_girth_m",
    "chest_girth_m",
    "inside_leg_m",
    "neck_girth_m",
    "hip_depth_m",
    "hip_breadth_m",
    "chest_depth_m",
]
FOLDS = 10


def soldiers(folder, sex):
    """Rows of age and logarithms, in the order of SOLDIERS."""
    path = pathlib.Path(folder) / ("female.csv.gz" if sex == "women" else "male.csv.gz")
    with gzip.open(path, "rt", encoding="utf-8-sig") as file:
        rows = list(csv.DictReader(file))
    columns = [[float(r["Age"]) for r in rows]]
    for column, women, men in SOLDIERS.values():
        share = women if sex == "women" else men
        columns.append([math.log(0.001 * share * float(r[column])) for r in rows])
    return numpy.array(columns).T


def civilians(path, sex):
    """Rows of age and logarithms in the order of BASE, and the weights of the rows."""
    with open(path, encoding="utf-8-sig") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    out, weights = [], []
    for r in rows:
        if r["Sex"] != ("Female" if sex == "women" else "Male"):
            continue
        try:
            out.append([float(r["Age"])] + [math.log(float(r[c]) * unit) for c, unit in CIVILIANS.values()])
            weights.append(float(r["SamplingWeight"]))
        except ValueError:
            continue  # a measure was not taken
    return numpy.array(out), numpy.array(weights)


def moments(rows, weights=None):
    weights = numpy.ones(len(rows)) if weights is None else weights
    mean = numpy.average(rows, axis=0, weights=weights)
    apart = rows - mean
    return mean, (apart * (weights / weights.sum())[:, None]).T @ apart


def regression(known, unknown, ridge=1e-6):
    """Slopes and means of unknown on known, and the covariance of what is left."""
    mean_known, mean_unknown = known.mean(0), unknown.mean(0)
    k, u = known - mean_known, unknown - mean_unknown
    slopes = numpy.linalg.solve(k.T @ k / len(k) + ridge * numpy.eye(k.shape[1]), k.T @ u / len(k))
    left = u - k @ slopes
    return slopes, mean_known, mean_unknown, left.T @ left / (len(k) - k.shape[1] - 1)


def extended(mean, covariance, at, model):
    """The joint distribution with what follows linearly from the variables at those places."""
    slopes, mean_known, mean_unknown, left = model
    new_mean = mean_unknown + (mean[at] - mean_known) @ slopes
    cross = covariance[:, at] @ slopes
    corner = slopes.T @ covariance[numpy.ix_(at, at)] @ slopes + left
    return numpy.concatenate([mean, new_mean]), numpy.block([[covariance, cross], [cross.T, corner]])


def bodies(path, sex):
    letter = "f" if sex == "women" else "m"
    return [p["measures"] for p in json.loads(pathlib.Path(path).read_text())["people"] if p["sex"] == letter]


def fit(sex, soldier_rows, civilian_rows, civilian_weights, people):
    base = [0] + [1 + list(SOLDIERS).index(key) for key in BASE[1:]]
    rest = [i for i in range(soldier_rows.shape[1]) if i not in base]
    # Half of the people are of each survey: where the surveys differ, in people or in where the tape lies,
    # the difference is part of the spread.
    means, covariances = zip(moments(soldier_rows[:, base]), moments(civilian_rows, civilian_weights))
    mean = 0.5 * (means[0] + means[1])
    apart = means[0] - means[1]
    covariance = 0.5 * (covariances[0] + covariances[1]) + 0.25 * numpy.outer(apart, apart)
    keys = BASE + [list(SOLDIERS)[i - 1] for i in rest]
    model = regression(soldier_rows[:, base], soldier_rows[:, rest])
    mean, covariance = extended(mean, covariance, list(range(len(base))), model)
    if not people:
        return keys, mean, covariance
    unknown = [key for key in OF_BODIES if key in people[0]]
    name = lambda key: "navel_girth_m" if key == "waist_navel_girth_m" else key
    logs = lambda wanted: numpy.log([[p[name(key)] for key in wanted] for p in people])
    at = [keys.index(key) for key in KNOWN_OF_BODIES]
    mean, covariance = extended(mean, covariance, at, regression(logs(KNOWN_OF_BODIES), logs(unknown)))
    return keys + unknown, mean, covariance


def conditional(mean, covariance, at, values):
    """Means and deviations of all, where the variables at those places have these values."""
    gain = numpy.linalg.solve(covariance[numpy.ix_(at, at)], covariance[at]).T
    means = mean + (values - mean[at]) @ gain.T
    left = numpy.sqrt(numpy.maximum(numpy.diag(covariance - gain @ covariance[at]), 0.0))
    return means, left


def print_errors(name, keys, model, rows, columns, known):
    mean, covariance = model
    at = [keys.index(key) for key in known]
    means, left = conditional(mean, covariance, at, rows[:, [columns.index(key) for key in known]])
    out = []
    for key in ("chest_girth_m", "waist_navel_girth_m", "hip_girth_m"):
        if key not in columns:
            continue
        i, truth = keys.index(key), rows[:, columns.index(key)]
        errors = 1000.0 * (numpy.exp(means[:, i]) - numpy.exp(truth))
        inside = numpy.abs(truth - means[:, i]) < 1.645 * left[i]
        out.append(f"{key} {numpy.abs(errors).mean():.0f} ({errors.mean():+.0f}) {100 * inside.mean():.0f} %")
    print(f"  {name:34s}", "   ".join(out))


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--soldiers", required=True, help="folder of female.csv.gz and male.csv.gz of ANSUR II"
    )
    parser.add_argument("--civilians", required=True, help="table of NHANES 2021 to 2023")
    parser.add_argument("--bodies", required=True, help="of vfit-bench population --space varied --json")
    parser.add_argument("--out", required=True)
    options = parser.parse_args()
    out = {
        "format": "vfit-population",
        "version": 1,
        "name": "adults",
        "source": "ANSUR II (2012) and NHANES (August 2021 to August 2023), both in the public domain; "
        "measures that neither has by generated bodies (training/population/fit.py)",
    }
    random = numpy.random.default_rng(1)
    for sex in ("women", "men"):
        s, (c, weights) = soldiers(options.soldiers, sex), civilians(options.civilians, sex)
        people = bodies(options.bodies, sex)
        print(
            f"{sex}: {len(s)} soldiers, {len(c)} civilians, {len(people)} bodies; held out, mean absolute "
            "error in mm (mean error), within 90 %:"
        )
        folds_s, folds_c = random.integers(0, FOLDS, len(s)), random.integers(0, FOLDS, len(c))
        # One fold alone tells enough: what is fitted has a hundredth as many numbers as there are rows.
        keys, mean, covariance = fit(sex, s[folds_s > 0], c[folds_c > 0], weights[folds_c > 0], [])
        columns = ["age_years"] + list(SOLDIERS)
        for known in (["stature_m", "body_mass_kg"], ["age_years", "stature_m", "body_mass_kg"]):
            told = " and ".join(key.split("_")[0] if key != "body_mass_kg" else "mass" for key in known)
            print_errors("soldiers, by " + told, keys, (mean, covariance), s[folds_s == 0], columns, known)
            print_errors("civilians, by " + told, keys, (mean, covariance), c[folds_c == 0], BASE, known)
        keys, mean, covariance = fit(sex, s, c, weights, people)
        out[sex] = {
            "keys": keys,
            "mean": [round(float(m), 6) for m in mean],
            "covariance": [
                [float(f"{covariance[i, k]:.6g}") for k in range(i + 1)] for i in range(len(keys))
            ],
        }
    text = json.dumps(out, indent=1)
    # A list of numbers, such as a row of the covariance, is a line.
    text = re.sub(r"\[\s+([^\[\]\"]*?)\s+\]", lambda m: "[" + " ".join(m[1].split()) + "]", text)
    pathlib.Path(options.out).write_text(text + "\n")


if __name__ == "__main__":
    main()
