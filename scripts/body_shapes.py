# SPDX-License-Identifier: Apache-2.0
"""The shape parameters of the baked body and the blend shapes that they drive.

A parameter has anchors: values at which one hat function is 1 and its neighbours are 0; between two anchors
both change linearly, and the outer ones go on linearly where the parameter's range goes beyond them. A term
is a set of anchors (parameter, index) whose hats are multiplied, and the displacement field that this product
scales. Many terms share one field: the files repeat the same height shape for each muscle and weight.
"""

import numpy as np

# Mean statures of ANSUR II (Gordon et al. 2014), 1986 women and 4082 men: the default bodies have them.
STATURE_M = {"female": 1.628, "male": 1.756}

# Anchors as MakeHuman sets them: age 0.1875 is 10 years, 0.5 is 25, 1 is 90. A middle anchor without a
# name is the unchanged body.
PHENOTYPES = {
    "gender": [(0.0, "female"), (1.0, "male")],
    "age": [(0.1875, "child"), (0.5, "young"), (1.0, "old")],
    "muscle": [(0.0, "minmuscle"), (0.5, "averagemuscle"), (1.0, "maxmuscle")],
    "weight": [(0.0, "minweight"), (0.5, "averageweight"), (1.0, "maxweight")],
    "height": [(0.0, "minheight"), (0.5, ""), (1.0, "maxheight")],
    "proportions": [(0.0, "uncommonproportions"), (0.5, ""), (1.0, "idealproportions")],
    "cupsize": [(0.0, "mincup"), (0.5, "averagecup"), (1.0, "maxcup")],
    "firmness": [(0.0, "minfirmness"), (0.5, "averagefirmness"), (1.0, "maxfirmness")],
}
# The rest: 0 to 1. Weight may go a little beyond its last anchor; further, bodies look lumpy.
RANGE = {"age": (0.1875, 1.0), "weight": (0.0, 1.15)}
ANCESTRIES = ("african", "asian", "caucasian")  # no parameter: their mean is part of the universal shapes

# Local sliders: those that change what a garment meets. Pose-like shifts of hands, feet and head, fingers and
# skin detail are left out.
SLIDER_FOLDERS = (
    "arms",
    "breast",
    "buttocks",
    "hip",
    "legs",
    "neck",
    "pelvis",
    "stomach",
    "torso",
    "feet",
    "hands",
    "head",
)
LEFT_OUT = ("nipple", "foot-trans", "hand-trans", "hand-fingers", "head-trans", "head-angle", "head-age")


SAME_M = 1e-6  # fields are one if they agree to this; the files give 1e-4


class Parameter:
    def __init__(self, key, anchors, minimum, maximum, female, male):
        self.key, self.anchors = key, anchors
        self.minimum, self.maximum = minimum, maximum
        self.female, self.male = female, male

    def hats(self, value):
        """The value of every anchor's hat function."""
        a = self.anchors
        value = min(max(value, self.minimum), self.maximum)
        i = max(0, min(len(a) - 2, int(np.searchsorted(a, value, side="right")) - 1))
        t = (value - a[i]) / (a[i + 1] - a[i])
        hats = [0.0] * len(a)
        hats[i], hats[i + 1] = 1.0 - t, t
        return hats


class ShapeSpace:
    def __init__(self, data, points):
        """`points` turns a displacement of the base mesh into one of the baked points."""
        self.data, self.points = data, points
        self.parameters, self.index = [], {}
        self.terms = []  # (factors, field)
        self.fields = []  # displacement of every point, metres
        self._field_of = {}
        for key, anchors in PHENOTYPES.items():
            low, high = RANGE.get(key, (0.0, 1.0))
            female, male = (0.0, 1.0) if key == "gender" else (0.5, 0.5)
            self._add_parameter(Parameter(key, [a for a, _ in anchors], low, high, female, male))
        self._add_phenotypes()
        self._add_sliders()

    def _add_parameter(self, parameter):
        self.index[parameter.key] = len(self.parameters)
        self.parameters.append(parameter)

    def _factor(self, key, name):
        return self.index[key], [n for _, n in PHENOTYPES[key]].index(name)

    def _add(self, factors, displacement):
        moved = self.points(displacement)
        if np.abs(moved).max() == 0.0:
            return
        content = np.rint(moved / SAME_M).astype(np.int32).tobytes()
        field = self._field_of.setdefault(content, len(self.fields))
        if field == len(self.fields):
            self.fields.append(moved)
        self.terms.append((factors, field))

    def _add_phenotypes(self):
        target = self.data.target
        names = {key: [name for _, name in anchors if name] for key, anchors in PHENOTYPES.items()}
        for gender in names["gender"]:
            for age in names["age"]:
                # The hats of muscle and weight sum to 1, so what depends on gender and age alone joins them.
                common = sum(target(f"macrodetails/{a}-{gender}-{age}") for a in ANCESTRIES) / len(ANCESTRIES)
                for muscle in names["muscle"]:
                    for weight in names["weight"]:
                        cell = f"{gender}-{age}-{muscle}-{weight}"
                        factors = [
                            self._factor("gender", gender),
                            self._factor("age", age),
                            self._factor("muscle", muscle),
                            self._factor("weight", weight),
                        ]
                        self._add(factors, common + target(f"macrodetails/universal-{cell}"))
                        for key in ("height", "proportions"):
                            for name in names[key]:
                                self._add(
                                    factors + [self._factor(key, name)],
                                    target(f"macrodetails/{key}/{cell}-{name}"),
                                )
                        for cup in names["cupsize"]:
                            for firmness in names["firmness"]:
                                path = f"breast/{cell}-{cup}-{firmness}"
                                if self.data.has_target(path):
                                    self._add(
                                        factors
                                        + [self._factor("cupsize", cup), self._factor("firmness", firmness)],
                                        target(path),
                                    )

    def _add_sliders(self):
        catalogue = self.data.json("targets/target.json")
        for folder in SLIDER_FOLDERS:
            for category in catalogue[folder]["categories"]:
                opposites = category.get("opposites", {})
                for side, prefix in (("unsided", ""), ("left", "l-"), ("right", "r-")):
                    low, high = opposites.get(f"negative-{side}"), opposites.get(f"positive-{side}")
                    if not low or not high or category["name"].startswith(LEFT_OUT):
                        continue
                    name = category["name"]
                    key = prefix + (name[: -len("-decr-incr")] if name.endswith("-decr-incr") else name)
                    self._add_parameter(Parameter(key, [-1.0, 0.0, 1.0], -1.0, 1.0, 0.0, 0.0))
                    for anchor, path in ((0, low), (2, high)):
                        self._add([(self.index[key], anchor)], self.data.target(f"{folder}/{path}"))

    def add_sections(self, fields):
        """Sliders that move points by their value times a field: (key, displacement of the baked points)."""
        for key, moved in fields:
            self._add_parameter(Parameter(key, [0.0, 1.0], -1.0, 1.0, 0.0, 0.0))
            self.terms.append(([(self.index[key], 1)], len(self.fields)))
            self.fields.append(moved)

    def coefficients(self, values):
        """Of every field: the sum of its terms' products."""
        hats = [p.hats(v) for p, v in zip(self.parameters, values)]
        coefficients = [0.0] * len(self.fields)
        for factors, field in self.terms:
            coefficients[field] += float(np.prod([hats[p][a] for p, a in factors]))
        return coefficients

    def default(self, sex):
        return [getattr(p, sex) for p in self.parameters]

    def evaluate(self, base, values):
        """Exact points of that shape, not yet put on the floor."""
        moved = base.copy()
        for coefficient, field in zip(self.coefficients(values), self.fields):
            if coefficient != 0.0:
                moved += coefficient * field
        return moved

    def set_default_stature(self, base, vertex_count):
        """Solves for the height parameter at which the default bodies have their stature."""
        height = self.parameters[self.index["height"]]
        for sex, stature in STATURE_M.items():

            def error(value):
                values = self.default(sex)
                values[self.index["height"]] = value
                y = self.evaluate(base, values)[:vertex_count, 1]
                return y.max() - y.min() - stature

            low, high = 0.0, 1.0
            for _ in range(20):  # bisection, to a millionth of the range
                middle = 0.5 * (low + high)
                low, high = (middle, high) if error(middle) < 0.0 else (low, middle)
            setattr(height, sex, round(0.5 * (low + high), 4))
