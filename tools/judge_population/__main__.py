"""Judges what a population makes of height, weight and age by tables of real people who were taped.

    build/venv/bin/python tools/judge_population TABLE...

A table is text with commas or tabs: one of those below, as it is published, or one of your own whose columns
are "sex" (f, m), "age_years" and keys of measures. Needs the Python package vfit.
"""

import argparse
import csv
from pathlib import Path

import numpy as np

INTERVAL = 1.645
GIRTHS = ("chest_girth_m", "waist_girth_m", "waist_navel_girth_m", "waist_minimum_girth_m", "hip_girth_m")
CM, INCH, POUND = 0.01, 0.0254, 0.45359237
# Published tables, by a column that no other has: column -> key and unit; "sex" with what a woman is, or the
# sex of all.
TABLES = {
    # Heinz, Peterson, Johnson, Kerk 2003: 507 physically active people. Waist: the narrowest part.
    "nav.gi": {
        "sex": ("sex", "0"),
        "age": ("age_years", 1.0),
        "hgt": ("stature_m", CM),
        "wgt": ("body_mass_kg", 1.0),
        "che.gi": ("chest_girth_m", CM),
        "wai.gi": ("waist_minimum_girth_m", CM),
        "nav.gi": ("waist_navel_girth_m", CM),
        "hip.gi": ("hip_girth_m", CM),
    },
    # Johnson 1996 (body fat): 252 men of 22 to 81 years. Abdomen: at the navel, level with the hip bones.
    "abdomen": {
        "sex": ("", "men"),
        "age": ("age_years", 1.0),
        "height": ("stature_m", INCH),
        "weight": ("body_mass_kg", POUND),
        "chest": ("chest_girth_m", CM),
        "abdomen": ("waist_navel_girth_m", CM),
        "hip": ("hip_girth_m", CM),
    },
    # NHANES as it is published by cycle; women and men in files of their own (--sex).
    "bmxwaist": {
        "bmxht": ("stature_m", CM),
        "bmxwt": ("body_mass_kg", 1.0),
        "bmxwaist": ("waist_navel_girth_m", CM),
        "bmxhip": ("hip_girth_m", CM),
    },
    # NHANES 2021 to 2023, on half of which, by weight, adults.json is fitted.
    "waistcm": {
        "sex": ("sex", "female"),
        "age": ("age_years", 1.0),
        "heightcm": ("stature_m", CM),
        "weightkg": ("body_mass_kg", 1.0),
        "waistcm": ("waist_navel_girth_m", CM),
        "hipcm": ("hip_girth_m", CM),
    },
}
SMALLEST_M = 0.3  # of a girth: less is refused wherever it comes in
ADULT = (18.0, 100.0)  # years
PLAUSIBLE_STATURE_M = (1.2, 2.3)  # a published table has a man of 75 cm


def read_table(path, sex):
    """People as dictionaries of "sex" and the keys that they have."""
    lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
    lines = [line for line in lines if line.strip() and not line.startswith("#")]
    if not lines:
        raise SystemExit(f"judge_population: {path}: is empty")
    delimiter = "\t" if "\t" in lines[0] else ","
    rows = [
        {k.strip().lower(): v for k, v in r.items() if k} for r in csv.DictReader(lines, delimiter=delimiter)
    ]
    columns = set(rows[0]) if rows else set()
    known = next((table for mark, table in TABLES.items() if mark in columns), None)
    if known is None:  # one of your own: what else it holds is passed over
        known = (
            {c: (c, 1.0) for c in rows[0] if c == "age_years" or c.endswith(("_m", "_kg"))} if rows else {}
        )
    people = []
    for row in rows:
        person = {"sex": sex or row.get("sex", "")}
        for column, (key, unit) in known.items():
            if column == "sex":
                person["sex"] = unit[0] if not key else "f" if row["sex"].strip().lower() == unit else "m"
                continue
            try:
                value = unit * float(row[column])
            except (KeyError, TypeError, ValueError):
                continue
            if value > SMALLEST_M and (key != "age_years" or ADULT[0] <= value <= ADULT[1]):
                person[key] = value
        if person["sex"] not in ("f", "m"):
            raise SystemExit(
                f'judge_population: {path}: the sex "{person["sex"]}" is neither f nor m (--sex)'
            )
        low, high = PLAUSIBLE_STATURE_M
        if low < person.get("stature_m", 0.0) < high and person.get("body_mass_kg", 0.0) > 0.0:
            people.append(person)
    if not people:
        raise SystemExit(f"judge_population: {path}: no person in it has a stature and a mass")
    return people


def report(title, people, estimate, told):
    """`told`: keys that the population is told; everyone in `people` has them."""
    errors = {}
    for person in people:
        known = {key: person[key] for key in told if key != "age_years"}
        age = person["age_years"] if "age_years" in told else None
        estimated = estimate(known, sex=person["sex"], age=age)
        for key in GIRTHS:
            if key in person and key in estimated:
                m = estimated[key]
                errors.setdefault(key, []).append((m.value - person[key], m.sigma))
    print(f"\n{title}, told {', '.join(told)}: {len(people)} people")
    for key, list_of in errors.items():
        error, sigma = np.array(list_of).T
        print(
            f"  {key:22}{1000 * np.abs(error).mean():7.0f} mm, mean error {1000 * error.mean():+5.0f}, "
            f"within 90 %: {100 * (np.abs(error) <= INTERVAL * sigma).mean():.0f} %"
        )
    return errors


def slipped(person, kind, random):
    """The person's measures with one slip, the key that is wrong, and what it was."""
    known = dict(person)
    girths = [key for key in known if key.endswith("_girth_m")]
    key = "body_mass_kg" if kind == "pounds" else str(random.choice(girths))
    meant = known[key]
    if kind == "pounds":
        known[key] = meant / POUND
    elif kind == "inches":
        known[key] = meant * CM / INCH
    elif kind == "tens digit":
        tens = int(meant * 10) % 10
        others = [meant + 0.1 * (digit - tens) for digit in range(10) if digit != tens]
        known[key] = float(random.choice([value for value in others if value > SMALLEST_M]))
    else:  # swapped
        key, meant = "stature_m", known["stature_m"]
        known[key], known[girths[0]] = known[girths[0]], known[key]
    return known, key, meant


def suggested(doubt, key, known):
    """What the doubt makes of that key: of a swap the other's value."""
    return doubt.suggested if key == doubt.key else known[doubt.key]


def report_slips(title, people, check):
    """False alarms, and slips of each kind that are found and undone to 3 %."""
    people = [{k: v for k, v in p.items() if k not in ("age_years",)} for p in people]
    people = [p for p in people if sum(key.endswith("_girth_m") for key in p) >= 2]
    if not people:
        return None
    measures = lambda person: {k: v for k, v in person.items() if k != "sex"}
    alarms = sum(bool(check(measures(p), sex=p["sex"])) for p in people)
    print(f"\n{title}: {len(people)} people, {100 * alarms / len(people):.1f} % of their lists are doubted")
    found = {}
    for kind in ("inches", "pounds", "tens digit", "swapped"):
        random = np.random.default_rng(1)
        right = 0
        for person in people:
            known, key, meant = slipped(measures(person), kind, random)
            doubts = check(known, sex=person["sex"])
            right += any(
                key in (d.key, d.other_key) and abs(suggested(d, key, known) / meant - 1) < 0.03
                for d in doubts
            )
        found[kind] = right / len(people)
        print(f"  {kind:12} found and undone: {100 * found[kind]:.0f} %")
    return alarms / len(people), found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tables", nargs="+", help="tables of people")
    parser.add_argument("--population", default="adults", help="name, or file (adults)")
    parser.add_argument("--sex", choices=("f", "m"), help="of all people of tables that do not say")
    options = parser.parse_args()
    import vfit

    with vfit.Context() as context:
        if options.population.endswith(".json"):
            population = vfit.Population.load(context, Path(options.population).read_text())
        else:
            population = vfit.Population.open(context, options.population)
        with population:
            for path in options.tables:
                people = read_table(path, options.sex)
                for sex, name in (("f", "women"), ("m", "men")):
                    some = [p for p in people if p["sex"] == sex]
                    if not some:
                        continue
                    title = f"{Path(path).name}, {name}"
                    report(title, some, population.estimate, ("stature_m", "body_mass_kg"))
                    aged = [p for p in some if "age_years" in p]
                    if aged:
                        told = ("stature_m", "body_mass_kg", "age_years")
                        report(title, aged, population.estimate, told)
                    report_slips(title, some, population.check)


if __name__ == "__main__":
    main()
