#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Learns measures from scans of virtual people (vfit-bench scan-features) and writes the model that the library reads.

For each sex a ridge regression of every tape measure on the features of a scan; whose sex nobody tells gets the
mixture of both by a logistic regression. Deviations follow the scan: a ridge regression of the logarithm of errors on
people who were held out, scaled so that 90 % of those errors lie within 1.645 of them. Needs numpy alone.
"""
import argparse
import json

import numpy as np

FOLDS = 5                  # people are held out whole
OTHER_SEX = 0.1            # how much of a row of the other sex counts: they share a little of what there is to learn
CLOTHED = 0.1              # and of a clothed scan for those in tight clothes: what the cloth adds is told to the regression
FIRM = 0.3                 # of the ridge, for the body's own numbers
FIRM_SURFACE = [3.0, 10.0, 30.0, 100.0, 300.0]  # for its surface: each measure takes what serves people held out best
FARTHEST = 5.0             # deviations: sdk/scan/measure_model.cpp cuts there too
# The order of sdk/scan/body_scan.h.
SHAPES, BASE, ZONES, PROFILE, REGIONS = 13, 16, 2 * 2 * 101, 2 * 14 * 4, 2 * 3
FEATURES = BASE + ZONES + PROFILE + REGIONS
ZONES_OF_CLOTH = 3
# What deviations follow: clothes in the fitted shape, distance and pixel, roughness.
SIGMA_FEATURES = [10, 11, 12, 14, 15] + list(range(BASE + ZONES + PROFILE, FEATURES))
LEAST_ERROR = 0.0005
# What is learnt apart: which features, from which scans.
KINDS = {"front": ("front", False), "front_and_side": ("both", False), "front_tight": ("front", True),
         "front_and_side_tight": ("both", True)}
# Seen itself from the front, and from both; the rest is inferred from what is seen.
SEEN_FROM_FRONT = {"stature_m", "shoulder_breadth_m", "inside_leg_m", "arm_length_m", "hip_breadth_m", "waist_breadth_m",
                   "chest_breadth_m", "head_width_m", "head_height_m", "hip_height_m", "torso_height_m",
                   "elbow_fingertip_m", "hand_length_m", "biacromial_breadth_m"}
NEVER_SEEN = {"body_mass_kg"}


def cloth(row):
    """Thickness on trunk, arms and legs, metres."""
    return [row["scene"][zone] for zone in ("top_m", "sleeves_m", "trousers_m")]


def tight(row):
    return max(cloth(row)) == 0.0


def read(files):
    rows = []
    for name in files:
        with open(name) as lines:
            rows += [json.loads(line) for line in lines if line.endswith("}\n")]
    return rows


class Equations:
    """Of the ridge regression y = base + weights . x with weighted rows."""

    def __init__(self, x, y, weight):
        self.mean_x, self.mean_y = np.average(x, 0, weight), np.average(y, 0, weight)
        root = np.sqrt(weight)[:, None]
        a = (x - self.mean_x) * root
        self.left, self.right = a.T @ a, a.T @ ((y - self.mean_y) * root)

    def solve(self, firmness):
        weights = np.linalg.solve(self.left + np.diag(firmness), self.right)
        return weights, self.mean_y - self.mean_x @ weights


def logistic(x, y, firmness=10.0, steps=25):
    """Weights and, last, the base of the logit."""
    x = np.c_[x, np.ones(len(x))]
    w = np.zeros(x.shape[1])
    hold = np.r_[np.full(len(w) - 1, firmness), 1e-3]
    for _ in range(steps):
        p = 1.0 / (1.0 + np.exp(-x @ w))
        hessian = (x * (p * (1.0 - p))[:, None]).T @ x + np.diag(hold)
        w -= np.linalg.solve(hessian, x.T @ (p - y) + hold * w)
    return w


class Part:
    """What is learnt from one kind of scan, whatever the firmness of the ridge. `own`: of that kind; of the other rows
    the thickness of the clothes is known, and what is learnt is for none."""

    def __init__(self, scans, own):
        features = scans.features[own]
        seen = np.isfinite(features)
        count = np.maximum(seen.sum(0), 1)
        self.mean = np.where(seen, features, 0.0).sum(0) / count
        self.scale = np.maximum(np.sqrt((np.where(seen, features - self.mean, 0.0) ** 2).sum(0) / count), 1e-3)
        x = self.standard(scans.features)
        self.logit = logistic(x[own], scans.female[own])
        self.usual_strangeness = float(np.quantile((x[own] ** 2).mean(1), 0.99))
        self.equations = []
        for sex in (1.0, 0.0):
            weight = np.where(scans.female == sex, 1.0, OTHER_SEX) * np.where(own, 1.0, CLOTHED)
            self.equations.append(Equations(np.c_[x, np.where(own[:, None], 0.0, scans.thickness)], scans.truth, weight))

    def standard(self, features):
        """What was not seen is taken as the mean."""
        x = np.clip((features - self.mean) / self.scale, -FARTHEST, FARTHEST)
        return np.where(np.isfinite(x), x, 0.0)

    def ridges(self, firm_surface):
        """Of women and of men, every measure with that firmness."""
        firmness = np.full(FEATURES + ZONES_OF_CLOTH, firm_surface)
        firmness[:BASE] = firmness[FEATURES:] = FIRM
        solved = [equations.solve(firmness) for equations in self.equations]
        return [(weights[:FEATURES], base) for weights, base in solved]

    def __call__(self, features, firm_surface):
        x = self.standard(features)
        p = (1.0 / (1.0 + np.exp(-(x @ self.logit[:-1] + self.logit[-1]))))[:, None]
        female, male = (base + x @ weights for weights, base in self.ridges(firm_surface))
        return p * female + (1.0 - p) * male


class Scans:
    def __init__(self, rows, view, keys):
        self.rows = [r for r in rows if r[view]]
        self.features = np.array([[np.nan if value is None else value for value in r[view]] for r in self.rows])  # null: not seen
        truth = np.array([[r["truth"].get(k, np.nan) for k in keys] for r in self.rows])
        # A man has no underbust: the mean of women stands in, and is not written for men.
        self.truth = np.where(np.isnan(truth), np.nanmean(truth, 0), truth)
        self.female = np.array([float(r["sex"] == "f") for r in self.rows])
        self.number = np.array([r["number"] for r in self.rows])
        self.thickness = 100 * np.array([cloth(r) for r in self.rows])

    def only(self, chosen):
        out = Scans.__new__(Scans)
        out.rows = [r for r, take in zip(self.rows, chosen) if take]
        for name in ("features", "truth", "female", "number", "thickness"):
            setattr(out, name, getattr(self, name)[chosen])
        return out


def held_out(scans, own):
    """What each row is told by a model that has not seen its person, one answer a firmness; and for each measure which of
    them is nearest to the truth."""
    told = np.empty((len(FIRM_SURFACE),) + scans.truth.shape)
    for fold in range(FOLDS):
        out = scans.number % FOLDS == fold
        part = Part(scans.only(~out), own[~out])
        for i, firm in enumerate(FIRM_SURFACE):
            told[i, out] = part(scans.features[out], firm)
    return told, np.argmin(np.abs(told - scans.truth)[:, own].mean(1), axis=0)


class Sigma:
    """Logarithm of a measure's deviation, linear in a few standardised features."""

    def __init__(self, x, error):
        x = x[:, SIGMA_FEATURES]
        equations = Equations(x, np.log(np.abs(error) + LEAST_ERROR), np.ones(len(x)))
        self.weights, base = equations.solve(np.full(x.shape[1], 30.0))
        within = np.quantile(np.abs(error) / np.exp(base + x @ self.weights), 0.90, axis=0)
        self.base = base + np.log(within / 1.645)

    def __call__(self, x):
        return np.exp(self.base + x[:, SIGMA_FEATURES] @ self.weights)


def digits(values, count):
    return [float(f"{v:.{count}g}") for v in np.asarray(values).ravel()]


SETS = {"in space": lambda r: tight(r) and r["space"] == "in", "off space": lambda r: tight(r) and r["space"] == "out",
        "clothed": lambda r: not tight(r)}


def train(rows, kind, keys):
    view, only_tight = KINDS[kind]
    scans = Scans(rows, view, keys)
    own = np.array([tight(r) or not only_tight for r in scans.rows])
    told, best = held_out(scans, own)
    measures = np.arange(len(keys))
    error = (told[best, :, measures].T - scans.truth)[own]
    part = Part(scans, own)
    rows, number = [r for r, take in zip(scans.rows, own) if take], scans.number[own]
    x = part.standard(scans.features[own])
    sigma = Sigma(x, error)
    inside = np.abs(error) <= 1.645 * sigma(x)
    print(f"\n{kind}: {len(rows)} scans of {len(set(zip(number, [r['space'] for r in rows])))} people, "
          "held out: mean absolute error (mm, kg) and share within 90 % intervals")
    chosen = {name: np.array([test(r) for r in rows]) for name, test in SETS.items()}
    for k, key in enumerate(keys):
        unit = 1 if key.endswith("_kg") else 1000
        print(f"  {key:22s}" + "".join(
            f"   {name} {unit * np.abs(error[m, k]).mean():5.1f} {100 * inside[m, k].mean():3.0f} %"
            for name, m in chosen.items() if m.any()))
    girths = [keys.index(k) for k in ("chest_girth_m", "waist_girth_m", "hip_girth_m")]
    correlation = np.corrcoef(error[:, girths].T)
    print(f"  errors' correlation: chest and waist {correlation[0, 1]:.2f}, chest and hip {correlation[0, 2]:.2f}, "
          f"waist and hip {correlation[1, 2]:.2f}")
    out = {"mean": digits(part.mean, 7), "scale": digits(part.scale, 5), "usual_strangeness": part.usual_strangeness,
           "female_weights": digits(part.logit[:-1], 4), "female_base": float(part.logit[-1]),
           "sigma_features": SIGMA_FEATURES}
    ridges = [part.ridges(firm) for firm in FIRM_SURFACE]
    for s, sex in enumerate(("female", "male")):
        weights = np.array([ridges[best[k]][s][0][:, k] for k in measures]).T
        base = np.array([ridges[best[k]][s][1][k] for k in measures])
        out[sex] = {key: {"observed": key in SEEN_FROM_FRONT or (view == "both" and key not in NEVER_SEEN),
                          "base": float(base[k]), "weights": digits(weights[:, k], 4),
                          "log_sigma": float(sigma.base[k]), "sigma_weights": digits(sigma.weights[:, k], 4)}
                    for k, key in enumerate(keys) if sex == "female" or key != "underbust_girth_m"}
    check_rounding(out, part, ridges, best, keys, scans.features)
    return out


def check_rounding(out, part, ridges, best, keys, features):
    """What the file's numbers tell is what was learnt: a mean of three digits once cost three millimetres of stature."""
    x = np.where(np.isfinite(features), np.clip((features - np.array(out["mean"])) / np.array(out["scale"]), -FARTHEST, FARTHEST), 0.0)
    for s, sex in enumerate(("female", "male")):
        for k, key in enumerate(keys):
            if key not in out[sex]:
                continue
            weights, base = ridges[best[k]][s]
            exact = part.standard(features) @ weights[:, k] + base[k]
            told = x @ np.array(out[sex][key]["weights"]) + out[sex][key]["base"]
            if np.abs(told - exact).max() > LEAST_ERROR * (100 if key.endswith("_kg") else 1):
                raise SystemExit(f"{key}: rounding costs {np.abs(told - exact).max()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scans", nargs="+", help="JSON lines of vfit-bench scan-features")
    parser.add_argument("--out", required=True, help="the model to write (assets/measures.json)")
    arguments = parser.parse_args()
    rows = read(arguments.scans)
    keys = sorted({key for r in rows for key in r["truth"]} - {"navel_girth_m"})
    model = {"format": "vfit-measure-model", "version": 2}
    for kind in KINDS:
        model[kind] = train(rows, kind, keys)
    with open(arguments.out, "w") as file:
        file.write(json.dumps(model, separators=(",", ":")))


if __name__ == "__main__":
    main()
