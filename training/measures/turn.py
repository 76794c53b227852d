#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Learns what girths read off a closed surface are off by, of a turn and of several cameras, from scans of
generated people (vfit-bench scan-features --turn, --cameras), and writes it into the measure model: by
clothes and sex a median, and a deviation of which 1.645 hold 90 % of errors. Needs numpy alone.
"""

import argparse
import json

import numpy as np
from train import read, tight

GIRTHS = (
    "chest_girth_m",
    "waist_girth_m",
    "hip_girth_m",
    "waist_navel_girth_m",
    "waist_minimum_girth_m",
)
SEXES = {"male": "m", "female": "f"}


def errors_of(rows, view, girth):
    """Of the truth from what is seen, metres."""
    seen = np.array([r[view][girth] for r in rows], dtype=float)
    off = np.array([r["truth"][girth] for r in rows]) - seen
    return off[np.isfinite(off)]


def learn(rows, view):
    out = {}
    for clothes, chosen in (("any", rows), ("tight", [r for r in rows if tight(r)])):
        out[clothes] = {}
        for sex, letter in SEXES.items():
            own = [r for r in chosen if r["sex"] == letter]
            out[clothes][sex] = {}
            for girth in GIRTHS:
                off = errors_of(own, view, girth)
                offset = float(np.median(off))
                sigma = float(np.quantile(np.abs(off - offset), 0.9)) / 1.645
                out[clothes][sex][girth] = {"offset": round(offset, 4), "sigma": round(sigma, 4)}
                print(
                    f"{clothes:6}{sex:8}{girth:22}{len(off):5} scans: offset {1000 * offset:6.1f}, "
                    f"sigma {1000 * sigma:5.1f} mm"
                )
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scans", nargs="+", help="JSON lines of vfit-bench scan-features")
    parser.add_argument("--model", required=True, help="the model to change (assets/measures.json)")
    arguments = parser.parse_args()
    rows = read(arguments.scans)
    with open(arguments.model) as file:
        model = json.load(file)
    for view in ("turn", "cameras"):
        seen = [r for r in rows if r.get("seen_" + view)]
        if seen:
            print(view)
            model[view] = learn(seen, "seen_" + view)
    with open(arguments.model, "w") as file:
        file.write(json.dumps(model, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()
