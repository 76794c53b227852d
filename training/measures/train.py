#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Learns measures from scans of generated people (vfit-bench scan-features), writes the library's model.

What the camera plainly sees (sdk/scan/seen_measures.h) is taken as it is, and what it is off by is learnt; of
the other measures the whole is. What is learnt is linear in the features of a scan, with weights that are
partly the same and partly apart for each sex, plus a smooth function of where the scan lies among those that
were learnt from: a Gaussian process (Rasmussen and Williams 2006, chapter 2) with the sum of both kernels,
the second one by its values at some of the scans (their section 8.3.1). A person of unknown sex gets the
mixture of both by a logistic regression.
Deviations follow the scan: a ridge regression of the logarithm of errors on people who were held out, scaled
so that 90 % of those errors lie within 1.645 of them. Needs numpy alone.
"""

import argparse
import json

import numpy as np

FOLDS = 5  # people are held out whole
TOGETHER = 0.8  # how much of what the features tell is the same for both sexes
CLOTHED = (
    0.1  # weight of a clothed scan for those in tight clothes: what the cloth adds is told to the regression
)
FIRM = 0.3  # of the ridge, for the body's own numbers, by a measure's variance
# For its surface: each measure takes what serves people held out best. A smaller one serves generated people
# a little better, and bodies of other makers worse.
FIRM_SURFACE = [1000.0, 3000.0]
SMOOTH = 30.0  # variance of the smooth function
CENTRES, DIRECTIONS = 1000, 40  # where it is known, and in how many directions of the features
WIDTH = 1.2  # of a centre, squared, by the usual squared distance of two scans
LEVEL = 100.0  # variance of what a sex has in common
JITTER = 1e-3  # of the kernel between centres: two that are alike say the same
FARTHEST = 5.0  # deviations: sdk/scan/measure_model.cpp cuts there too
# The order of sdk/scan/body_scan.h.
CROWN = 13
SHAPE = 10  # of the base: of the body itself, without clothes
BASE, ZONES, PROFILE, REGIONS = 19, 2 * 2 * 171, 24 * (5 + 9), 2 * 3
FEATURES = BASE + ZONES + PROFILE + REGIONS
# What deviations follow: the fitted shape and its clothes, distance and pixel, roughness, and how strange
# all of it is.
SIGMA_FEATURES = list(range(13)) + [14, 15] + list(range(BASE + ZONES + PROFILE, FEATURES))
LEAST_ERROR = 0.0005
LEAST_STRANGENESS = 0.01  # sdk/scan/measure_model.cpp has the same
UNIT, UNIT_OF_PLACES = 1e-6, 1e-5  # the file's numbers are whole ones of these
# What is learnt apart: which features, from which scans.
KINDS = {
    "front": ("front", False),
    "front_and_side": ("both", False),
    "front_tight": ("front", True),
    "front_and_side_tight": ("both", True),
}
# Seen itself from the front, and from both; the rest is inferred from what is seen.
SEEN_FROM_FRONT = {
    "stature_m",
    "shoulder_breadth_m",
    "inside_leg_m",
    "arm_length_m",
    "hip_breadth_m",
    "waist_breadth_m",
    "chest_breadth_m",
    "head_width_m",
    "head_height_m",
    "hip_height_m",
    "torso_height_m",
    "elbow_fingertip_m",
    "hand_length_m",
    "biacromial_breadth_m",
}
NEVER_SEEN = {"body_mass_kg"}
SEEN_AS_IT_IS = (  # sdk/scan/seen_measures.h
    "stature_m",
    "waist_girth_m",
    "hip_girth_m",
    "waist_navel_girth_m",
    "waist_minimum_girth_m",
)
# In girths that are seen, against what generated people make likely: nothing of it serves those best, all of
# it bodies of other makers.
TRUST = 0.75
MISREAD = 3.0  # of a stand-in's deviations; sdk/scan/measure_model.cpp has the same
# Metres: generated people make a stature likely to 5 mm, which no body of another maker keeps to.
LEAST_DEVIATION = 0.017
FEWEST_SEEN = 0.5  # of the scans: a measure that fewer see is learnt whole
# So is one whose error on people held out is above 1.2 times what it is when it is learnt whole.
WORTH_OF_SEEING = 1.0 / 1.2


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
    for row in rows:
        for view in ("front", "both"):
            if row[view] and len(row[view]) != FEATURES:
                raise SystemExit(
                    f"a scan of person {row['number']} has {len(row[view])} features, not {FEATURES}: "
                    "it was made by another version"
                )
    return rows


def ridge(x, y, weight, firmness):
    """Weights and base of y = base + x . weights with weighted rows."""
    mean_x, mean_y = np.average(x, 0, weight), np.average(y, 0, weight)
    a = (x - mean_x) * weight[:, None]
    weights = np.linalg.solve(a.T @ (x - mean_x) + firmness * np.eye(x.shape[1]), a.T @ (y - mean_y))
    return weights, mean_y - mean_x @ weights


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


class Centres:
    """Some of the scans, and how near another one is to each: in the directions that measures depend on."""

    def __init__(self, x, y, weight):
        relevance = np.abs(ridge(x, y, weight, FIRM_SURFACE[0])[0])
        relevance = np.sqrt((relevance / relevance.sum(0)).mean(1))
        vectors = np.linalg.eigh(np.cov((x * relevance).T, aweights=weight))[1][:, ::-1][:, :DIRECTIONS]
        self.directions = relevance[:, None] * vectors
        chosen = np.random.default_rng(1).choice(
            len(x), min(CENTRES, len(x)), replace=False, p=weight / weight.sum()
        )
        self.centres = x[chosen] @ self.directions
        usual = np.sqrt(WIDTH * np.median(self.squares(self.centres)))
        self.directions /= usual
        self.centres /= usual
        values, vectors = np.linalg.eigh(self.near(x[chosen]) + JITTER * np.eye(len(chosen)))
        self.root = vectors / np.sqrt(values)

    def squares(self, z):
        return np.maximum(
            (z * z).sum(1)[:, None] + (self.centres * self.centres).sum(1) - 2 * z @ self.centres.T, 0.0
        )

    def near(self, x):
        return np.exp(-0.5 * self.squares(x @ self.directions))


class Part:
    """What is learnt from one kind of scan, whatever the firmness of the ridge. `own`: of that kind; of the
    other rows the thickness of the clothes is known, and what is learnt is for none."""

    def __init__(self, scans, own):
        features = scans.features[own]
        seen = np.isfinite(features)
        count = np.maximum(seen.sum(0), 1)
        self.used = seen.any(0)
        self.mean = np.where(seen, features, 0.0).sum(0) / count
        self.scale = np.maximum(
            np.sqrt((np.where(seen, features - self.mean, 0.0) ** 2).sum(0) / count), 1e-3
        )
        self.x, self.female, self.weight = (
            self.standard(scans.features),
            scans.female,
            np.where(own, 1.0, CLOTHED),
        )
        self.logit = logistic(self.x[own], scans.female[own])
        self.usual_strangeness = float(np.quantile((self.x[own] ** 2).mean(1), 0.99))
        self.stature = scans.stature
        self.learn_stand_in(scans.seen)
        unexplained = scans.truth - self.seen_or_likely(scans.seen, self.x)
        self.mean_y = np.average(unexplained, 0, self.weight)
        self.y = unexplained - self.mean_y
        self.cloth = np.where(own[:, None], 0.0, scans.thickness)
        self.centres = Centres(self.x[:, self.used], scans.truth, self.weight)
        # Mahalanobis' distance of the fitted shape, as a share of that which one person of ten exceeds.
        shape = self.x[own][:, :SHAPE]
        precision = np.linalg.inv(shape.T @ shape / len(shape))
        self.shape_precision = precision / np.quantile(((shape @ precision) * shape).sum(1), 0.9)

    def learn_stand_in(self, seen):
        """For what a scan does not see though most do, or misreads: what all features make likely."""
        firm = np.sqrt(np.where(np.flatnonzero(self.used) < BASE, FIRM, FIRM_SURFACE[0]))
        self.stand_in = {}
        for k in range(seen.shape[1]):
            told = np.isfinite(seen[:, k])
            if told.mean() < FEWEST_SEEN:
                continue
            x, y = self.x[told][:, self.used] / firm, seen[told, k : k + 1]
            if k == self.stature:  # the crown is what is seen
                x[:, np.flatnonzero(self.used) == CROWN] = 0.0
            weights, base = ridge(x, y, self.weight[told], 1.0)
            off = np.abs(y - base - x @ weights)
            deviation = max(LEAST_DEVIATION, float(np.quantile(off, 0.9)) / 1.645)
            self.stand_in[k] = weights[:, 0] / firm, float(base[0]), deviation

    def trust(self, k):
        return 1.0 if k == self.stature else TRUST

    def seen_or_likely(self, seen, x):
        """0 for measures that are learnt whole."""
        out = np.zeros_like(seen)
        for k, (weights, base, deviation) in self.stand_in.items():
            likely = base + x[:, self.used] @ weights
            misread = ~(np.abs(seen[:, k] - likely) <= MISREAD * deviation)
            out[:, k] = likely + np.where(misread, 0.0, self.trust(k) * (seen[:, k] - likely))
        return out

    def standard(self, features):
        """What was not seen is taken as the mean."""
        x = np.clip((features - self.mean) / self.scale, -FARTHEST, FARTHEST)
        return np.where(np.isfinite(x), x, 0.0)

    def ridges(self, firm_surface):
        """Weights of women and of men with their base, and of the centres, for every measure."""
        count = self.used.sum()
        firm = np.sqrt(np.where(np.flatnonzero(self.used) < BASE, FIRM, firm_surface))
        both, apart = np.sqrt(TOGETHER) / firm, np.sqrt(1.0 - TOGETHER) / firm
        sex, x = np.c_[self.female, 1.0 - self.female], self.x[:, self.used]
        columns = np.c_[
            x * both,
            x * apart * sex[:, :1],
            x * apart * sex[:, 1:],
            np.sqrt(SMOOTH) * self.centres.near(x) @ self.centres.root,
            np.sqrt(LEVEL) * sex,
            self.cloth,
        ]
        a, b = columns * np.sqrt(self.weight)[:, None], self.y * np.sqrt(self.weight)[:, None]
        solved = np.linalg.solve(a.T @ a + np.eye(a.shape[1]), a.T @ b)
        shared, smooth = both[:, None] * solved[:count], solved[3 * count :][: len(self.centres.root)]
        level = self.mean_y + np.sqrt(LEVEL) * solved[3 * count + len(smooth) :][:2]
        sexes = [(shared + apart[:, None] * solved[(s + 1) * count :][:count], level[s]) for s in (0, 1)]
        return sexes, np.sqrt(SMOOTH) * self.centres.root @ smooth

    def __call__(self, features, seen, firm_surface):
        x = self.standard(features)
        p = (1.0 / (1.0 + np.exp(-(x @ self.logit[:-1] + self.logit[-1]))))[:, None]
        sexes, smooth = self.ridges(firm_surface)
        female, male = (base + x[:, self.used] @ weights for weights, base in sexes)
        bent = self.centres.near(x[:, self.used]) @ smooth
        return self.seen_or_likely(seen, x) + p * female + (1.0 - p) * male + bent


class Scans:
    def __init__(self, rows, view, keys):
        self.rows = [r for r in rows if r[view]]
        self.stature = list(keys).index("stature_m")
        self.features = np.array(
            [[np.nan if value is None else value for value in r[view]] for r in self.rows]
        )  # null: not seen
        truth = np.array([[r["truth"].get(k, np.nan) for k in keys] for r in self.rows])
        self.seen = np.array(
            [[r["seen_" + view].get(k) if k in SEEN_AS_IT_IS else None for k in keys] for r in self.rows],
            dtype=float,
        )
        # A man has no underbust: the mean of women stands in, and is not written for men.
        self.truth = np.where(np.isnan(truth), np.nanmean(truth, 0), truth)
        self.female = np.array([float(r["sex"] == "f") for r in self.rows])
        self.number = np.array([r["number"] for r in self.rows])
        self.thickness = 100 * np.array([cloth(r) for r in self.rows])

    def only(self, chosen):
        out = Scans.__new__(Scans)
        out.rows = [r for r, take in zip(self.rows, chosen) if take]
        out.stature = self.stature
        for name in ("features", "truth", "seen", "female", "number", "thickness"):
            setattr(out, name, getattr(self, name)[chosen])
        return out


def held_out(scans, own):
    """What each row is told by a model that has not seen its person, one answer a firmness; and for each
    measure which of them is nearest to the truth."""
    told = np.empty((len(FIRM_SURFACE),) + scans.truth.shape)
    for fold in range(FOLDS):
        out = scans.number % FOLDS == fold
        part = Part(scans.only(~out), own[~out])
        for i, firm in enumerate(FIRM_SURFACE):
            told[i, out] = part(scans.features[out], scans.seen[out], firm)
    return told, np.argmin(np.abs(told - scans.truth)[:, own].mean(1), axis=0)


def error_of(told, best, truth):
    return told[best, :, np.arange(truth.shape[1])].T - truth


def choose_seen(scans, own):
    """Leaves in scans.seen what is worth it; what held_out says then."""
    told, best = held_out(scans, own)
    with_it = np.abs(error_of(told, best, scans.truth)[own]).mean(0)
    seen = scans.seen.copy()
    girths = [
        k for k in range(seen.shape[1]) if k != scans.stature and np.isfinite(seen[:, k]).mean() > FEWEST_SEEN
    ]
    if not girths:
        return told, best
    scans.seen[:, girths] = np.nan
    without = np.abs(error_of(*held_out(scans, own), scans.truth)[own]).mean(0)
    kept = [k for k in girths if without[k] > WORTH_OF_SEEING * with_it[k]]
    scans.seen[:, kept] = seen[:, kept]
    return held_out(scans, own) if len(kept) < len(girths) else (told, best)


class Sigma:
    """Logarithm of a measure's deviation, linear in a few standardised features."""

    def __init__(self, x, error, off_space):
        x = self.tells(x)
        self.weights, base = ridge(x, np.log(np.abs(error) + LEAST_ERROR), np.ones(len(x)), 30.0)
        ratio = np.abs(error) / np.exp(base + x @ self.weights)
        within = np.quantile(
            np.r_[ratio, ratio[off_space]], 0.90, axis=0
        )  # off space counts twice: real people are like that
        self.base = base + np.log(within / 1.645)

    def __call__(self, x):
        return np.exp(self.base + self.tells(x) @ self.weights)

    @staticmethod
    def tells(x):
        return np.c_[x[:, SIGMA_FEATURES], np.log((x**2).mean(1) + LEAST_STRANGENESS)]


def digits(values, count):
    return [float(f"{v:.{count}g}") for v in np.asarray(values).ravel()]


def whole(values, unit):
    return np.rint(np.asarray(values).ravel() / unit).astype(int).tolist()


SETS = {
    "varied": lambda r: tight(r) and r["space"] == "varied",
    "in space": lambda r: tight(r) and r["space"] == "in",
    "off space": lambda r: tight(r) and r["space"] == "out",
    "clothed": lambda r: not tight(r),
}


def train(rows, kind, keys):
    view, only_tight = KINDS[kind]
    scans = Scans(rows, view, keys)
    own = np.array([tight(r) or not only_tight for r in scans.rows])
    told, best = choose_seen(scans, own)
    error = error_of(told, best, scans.truth)[own]
    part = Part(scans, own)
    rows, number = [r for r, take in zip(scans.rows, own) if take], scans.number[own]
    x = part.standard(scans.features[own])
    sigma = Sigma(x, error, np.array([r["space"] == "out" for r in rows]))
    seen_keys = ", ".join(keys[k] for k in sorted(part.stand_in))
    inside = np.abs(error) <= 1.645 * sigma(x)
    print(
        f"\n{kind}: {len(rows)} scans of {len(set(zip(number, [r['space'] for r in rows])))} people, "
        "held out: mean absolute error (mm, kg) and fraction within 90 % intervals; seen as they are: "
        + (seen_keys or "none")
    )
    chosen = {name: np.array([test(r) for r in rows]) for name, test in SETS.items()}
    for k, key in enumerate(keys):
        unit = 1 if key.endswith("_kg") else 1000
        print(
            f"  {key:22s}"
            + "".join(
                f"   {name} {unit * np.abs(error[m, k]).mean():5.1f} {100 * inside[m, k].mean():3.0f} %"
                for name, m in chosen.items()
                if m.any()
            )
        )
    girths = [keys.index(k) for k in ("chest_girth_m", "waist_girth_m", "hip_girth_m")]
    correlation = np.corrcoef(error[:, girths].T)
    print(
        f"  errors' correlation: chest and waist {correlation[0, 1]:.2f}, "
        f"chest and hip {correlation[0, 2]:.2f}, waist and hip {correlation[1, 2]:.2f}"
    )
    used = part.used
    out = {
        "features": np.flatnonzero(used).tolist(),
        "mean": digits(part.mean[used], 7),
        "scale": digits(part.scale[used], 5),
        "usual_strangeness": part.usual_strangeness,
        "shape_precision": digits(part.shape_precision, 5),
        "female_weights": digits(part.logit[:-1][used], 4),
        "female_base": float(part.logit[-1]),
        "directions": whole(part.centres.directions.T, UNIT_OF_PLACES),
        "centres": whole(part.centres.centres, UNIT_OF_PLACES),
        "sigma_features": SIGMA_FEATURES,
    }
    solved = [part.ridges(firm) for firm in FIRM_SURFACE]
    out["bends"] = {key: whole(solved[best[k]][1][:, k], UNIT) for k, key in enumerate(keys)}
    for s, sex in enumerate(("female", "male")):
        out[sex] = {}
        for k, key in enumerate(keys):
            if sex == "male" and key == "underbust_girth_m":
                continue
            weights, base = solved[best[k]][0][s]
            out[sex][key] = {
                "observed": key in SEEN_FROM_FRONT or (view == "both" and key not in NEVER_SEEN),
                "base": float(base[k]),
                "weights": whole(weights[:, k], UNIT),
                "log_sigma": float(sigma.base[k]),
                "sigma_weights": digits(sigma.weights[:, k], 4),
            }
            if k in part.stand_in:
                weights, base, deviation = part.stand_in[k]
                out[sex][key]["stand_in"] = {
                    "base": base,
                    "weights": whole(weights, UNIT),
                    "sigma": deviation,
                    "trust": part.trust(k),
                }
    check_rounding(out, part, solved, best, keys, scans.features)
    return out


def check_rounding(out, part, solved, best, keys, features):
    """The file's numbers tell what was learnt: a mean of three digits once cost 3 mm of stature."""
    features, exact_x = features[:, part.used], part.standard(features)[:, part.used]
    x = np.where(
        np.isfinite(features),
        np.clip((features - np.array(out["mean"])) / np.array(out["scale"]), -FARTHEST, FARTHEST),
        0.0,
    )
    place = x @ (UNIT_OF_PLACES * np.array(out["directions"]).reshape(-1, x.shape[1]).T)
    centres = UNIT_OF_PLACES * np.array(out["centres"]).reshape(-1, place.shape[1])
    near = np.exp(
        -0.5 * ((place * place).sum(1)[:, None] + (centres * centres).sum(1) - 2 * place @ centres.T)
    )
    exact_near = part.centres.near(exact_x)
    for s, sex in enumerate(("female", "male")):
        for k, key in enumerate(keys):
            if key not in out[sex]:
                continue
            sexes, smooth = solved[best[k]]
            weights, base = sexes[s]
            exact = exact_x @ weights[:, k] + base[k] + exact_near @ smooth[:, k]
            told = (
                UNIT * (x @ np.array(out[sex][key]["weights"]) + near @ np.array(out["bends"][key]))
                + out[sex][key]["base"]
            )
            if np.abs(told - exact).max() > LEAST_ERROR * (100 if key.endswith("_kg") else 1):
                raise SystemExit(f"{key}: rounding costs {np.abs(told - exact).max()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scans", nargs="+", help="JSON lines of vfit-bench scan-features")
    parser.add_argument("--out", required=True, help="the model to write (assets/measures.json)")
    arguments = parser.parse_args()
    rows = read(arguments.scans)
    keys = sorted({key for r in rows for key in r["truth"] if not key.startswith("navel_")})
    model = {"format": "vfit-measure-model", "version": 8, "unit": UNIT, "unit_of_places": UNIT_OF_PLACES}
    for kind in KINDS:
        model[kind] = train(rows, kind, keys)
    with open(arguments.out, "w") as file:
        file.write(json.dumps(model, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()
