# SPDX-License-Identifier: Apache-2.0
"""Sliders for the form of the trunk's sections, beside MakeHuman's.

MakeHuman's sliders make a trunk wider, deeper or fuller at a place, but a section of given breadth and
depth always has much the same perimeter, and none is as full as a very heavy person's. Real perimeters
scatter by 15 to 24 mm about breadth and depth (ANSUR II). These sliders bend and fill sections by harmonics
of the angle about the trunk's axis.
"""

import numpy as np

# Heights of the sections, as fractions of the way from the crotch to the neck's root. A slider acts at its
# own and fades out towards its neighbours.
LEVELS = {"hip": 0.14, "belly": 0.33, "waist": 0.5, "chest": 0.72}
ENDS = (0.0, 1.0)

# Metres of a slider at 1, and how it bends a section by the angle on the section's ellipse: 0 in front, a
# quarter turn at the person's left.
FORMS = {
    "full": (0.06, lambda a: np.ones_like(a)),
    "front": (0.06, lambda a: 0.25 * (1.0 + np.cos(a)) ** 2),
    # These leave front, back and sides where they are, except that `skew` moves them by the second order.
    "square": (0.01, lambda a: 0.5 * (1.0 - np.cos(4.0 * a))),
    "square-front": (0.01, lambda a: 0.5 * (1.0 - np.cos(4.0 * a)) * np.cos(a)),
    "square-left": (0.01, lambda a: 0.5 * (1.0 - np.cos(4.0 * a)) * np.sin(a)),
    "skew": (0.01, lambda a: np.sin(2.0 * a)),
}


def window(heights, name):
    """1 at the level, 0 at its neighbours, smooth between."""
    places = [ENDS[0], *LEVELS.values(), ENDS[1]]
    i = 1 + list(LEVELS).index(name)
    share = np.interp(heights, places[i - 1 : i + 2], [0.0, 1.0, 0.0], left=0.0, right=0.0)
    return share * share * (3.0 - 2.0 * share)


def section_fields(vertices, of_trunk, crotch_m, neck_m):
    """Slider key and displacement (metres) of every vertex. of_trunk: 0 to 1, 0 on arms and head."""
    height = (vertices[:, 1] - crotch_m) / (neck_m - crotch_m)
    steps = np.linspace(0.0, 0.9, 19)
    ellipses = []
    for step in steps:
        here = vertices[(np.abs(height - step) < 0.05) & (of_trunk > 0.5)]
        front, back = here[:, 2].max(), here[:, 2].min()
        ellipses.append((np.abs(here[:, 0]).max(), 0.5 * (front - back), 0.5 * (front + back)))
    breadth, depth, middle = (np.interp(height, steps, column) for column in np.transpose(ellipses))
    x, z = vertices[:, 0] / breadth, (vertices[:, 2] - middle) / depth
    outwards = np.stack([x / breadth, 0.0 * x, z / depth], axis=1)
    outwards /= np.maximum(np.linalg.norm(outwards, axis=1, keepdims=True), 1e-9)
    for level in LEVELS:
        for form, (amplitude_m, bend) in FORMS.items():
            amount = amplitude_m * window(height, level) * of_trunk * bend(np.arctan2(x, z))
            yield f"section-{level}-{form}", amount[:, None] * outwards
