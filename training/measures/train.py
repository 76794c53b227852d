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

FOLDS = 5                  # people are held out whole, with all their scans
OTHER_SEX = 0.05           # how much of a row of the other sex counts: they share a little of what there is to learn
FIRM, FIRM_ZONES = 0.3, 100.0  # of the ridge, for the body's own numbers and for zones
FARTHEST = 5.0             # deviations: sdk/scan/measure_model.cpp cuts there too
SHAPES, BASE, ZONES, REGIONS = 13, 16, 2 * 2 * 96, 2 * 3
FEATURES = BASE + ZONES + REGIONS
# What deviations follow: clothes in the fitted shape, distance and pixel, roughness.
SIGMA_FEATURES = [10, 11, 12, 14, 15] + list(range(BASE + ZONES, FEATURES))
LEAST_ERROR_M = 0.0005
VIEWS = {"front": "front", "both": "front_and_side"}
# Seen itself from the front and from the side; the rest is inferred from what is seen.
OBSERVED = {
    "front": {"stature_m", "shoulder_breadth_m", "inside_leg_m", "arm_length_m", "hip_breadth_m", "waist_breadth_m",
              "chest_breadth_m", "head_width_m", "head_height_m", "hip_height_m", "torso_height_m",
              "elbow_fingertip_m", "hand_length_m", "biacromial_breadth_m"},
}


def read(files):
    rows = []
    for name in files:
        with open(name) as lines:
            rows += [json.loads(line) for line in lines if line.endswith("}\n")]
    return rows


class Ridge:
    """y = base + weights . x, rows weighted."""

    def __init__(self, x, y, weight, firmness):
        mean_x, mean_y = np.average(x, 0, weight), np.average(y, 0, weight)
        root = np.sqrt(weight)[:, None]
        a = (x - mean_x) * root
        self.weights = np.linalg.solve(a.T @ a + np.diag(firmness), a.T @ ((y - mean_y) * root))
        self.base = mean_y - mean_x @ self.weights

    def __call__(self, x):
        return self.base + x @ self.weights


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
    """What is learnt from one kind of scan."""

    def __init__(self, features, truth, female):
        self.mean, self.scale = features.mean(0), np.maximum(features.std(0), 1e-3)
        x = self.standard(features)
        firmness = np.full(FEATURES, FIRM_ZONES)
        firmness[:BASE] = FIRM
        self.logit = logistic(x, female)
        self.by_sex = [Ridge(x, truth, np.where(female == sex, 1.0, OTHER_SEX), firmness) for sex in (1.0, 0.0)]
        self.usual_strangeness = float(np.quantile((x ** 2).mean(1), 0.99))

    def standard(self, features):
        return np.clip((features - self.mean) / self.scale, -FARTHEST, FARTHEST)

    def female(self, x):
        return 1.0 / (1.0 + np.exp(-(x @ self.logit[:-1] + self.logit[-1])))

    def __call__(self, features):
        x = self.standard(features)
        p = self.female(x)[:, None]
        return p * self.by_sex[0](x) + (1.0 - p) * self.by_sex[1](x)


def held_out(features, truth, female, number):
    """What each row is told by a model that has not seen its person."""
    told = np.empty_like(truth)
    for fold in range(FOLDS):
        out = number % FOLDS == fold
        told[out] = Part(features[~out], truth[~out], female[~out])(features[out])
    return told


class Sigma:
    """Logarithm of a measure's deviation, linear in a few standardised features."""

    def __init__(self, x, error):
        x = x[:, SIGMA_FEATURES]
        self.model = Ridge(x, np.log(np.abs(error) + LEAST_ERROR_M), np.ones(len(x)), np.full(x.shape[1], 30.0))
        within = np.quantile(np.abs(error) / np.exp(self.model(x)), 0.90, axis=0)
        self.model.base = self.model.base + np.log(within / 1.645)

    def __call__(self, x):
        return np.exp(self.model(x[:, SIGMA_FEATURES]))


def digits(values):
    return [float(f"{v:.4g}") for v in np.asarray(values).ravel()]


def train(rows, view, keys, sets):
    rows = [r for r in rows if r[view]]
    features = np.array([r[view] for r in rows])
    truth = np.array([[r["truth"].get(k, np.nan) for k in keys] for r in rows])
    female = np.array([float(r["sex"] == "f") for r in rows])
    # A man has no underbust: the mean of women stands in, and is not written for men.
    truth = np.where(np.isnan(truth), np.nanmean(truth, 0), truth)
    number = np.array([r["number"] for r in rows])
    error = held_out(features, truth, female, number) - truth
    part = Part(features, truth, female)
    x = part.standard(features)
    sigma = Sigma(x, error)
    inside = np.abs(error) <= 1.645 * sigma(x)
    print(f"\n{VIEWS[view]}: {len(rows)} scans of {len(set(zip(number, [r['space'] for r in rows])))} people, "
          "held out: mean absolute error (mm) and share within 90 % intervals")
    chosen = [np.array([test(r) for r in rows]) for test in sets.values()]
    for k, key in enumerate(keys):
        print(f"  {key:22s}" + "".join(
            f"   {name} {1000 * np.abs(error[m, k]).mean():5.1f} {100 * inside[m, k].mean():3.0f} %"
            for name, m in zip(sets, chosen)))
    out = {"mean": digits(part.mean), "scale": digits(part.scale), "usual_strangeness": part.usual_strangeness,
           "female_weights": digits(part.logit[:-1]), "female_base": float(part.logit[-1]),
           "sigma_features": SIGMA_FEATURES}
    for sex, model in zip(("female", "male"), part.by_sex):
        out[sex] = {key: {"observed": view == "both" or key in OBSERVED["front"], "base_m": float(model.base[k]),
                          "weights": digits(model.weights[:, k]), "log_sigma": float(sigma.model.base[k]),
                          "sigma_weights": digits(sigma.model.weights[:, k])}
                    for k, key in enumerate(keys) if sex == "female" or key != "underbust_girth_m"}
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scans", nargs="+", help="JSON lines of vfit-bench scan-features")
    parser.add_argument("--out", required=True, help="the model to write (assets/measures.json)")
    arguments = parser.parse_args()
    rows = read(arguments.scans)
    keys = sorted({key for r in rows for key in r["truth"]} - {"navel_girth_m"})

    def tight(r):
        return max(r["scene"][zone] for zone in ("top_m", "sleeves_m", "trousers_m")) == 0.0

    sets = {"in space": lambda r: tight(r) and r["space"] == "in", "off space": lambda r: tight(r) and r["space"] == "out",
            "clothed": lambda r: not tight(r)}
    model = {"format": "vfit-measure-model", "version": 1}
    for view, name in VIEWS.items():
        model[name] = train(rows, view, keys, sets)
    with open(arguments.out, "w") as file:
        file.write(json.dumps(model, separators=(",", ":")))


if __name__ == "__main__":
    main()
