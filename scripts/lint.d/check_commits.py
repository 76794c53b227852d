"""Subjects of commits since the base: "area: imperative", at most 72 characters, no period at the end."""

import re

from tree import Breach

LIMIT = 72
FIRST_DAY = "2026-11-25"  # docs/style.md; what was written before is exempt
AREA = re.compile(r"[A-Za-z0-9][\w./+-]*(, [A-Za-z0-9][\w./+-]*)*: (?=\S)")
NO_VERB = set("the a an all no its their this that it some every each more".split())
# Verbs of commit subjects, to know their other forms: a plain -s or -ed would refuse "process", "embed".
VERBS = """
accept add adjust allow apply ask avoid bake bind bound build bump call carry change check clean
close compare compile compute cook copy correct count cover cut declare default define delete
describe disable document draw drop emit enable ensure export extend fail fill find fit fix follow
format give handle hold honour ignore import improve include install introduce join keep limit link
list load lock make map mark measure merge move name normalize note open parse pass pin place plan
prefer prevent print put read record reduce refactor refuse release remove rename replace report
require reset resolve restore return reuse run say send separate set show shrink simplify skip sleep
solve sort split start state step stop store support take teach tell test throw time train trim turn
update use validate wait warn wrap write
""".split()


def _forms(verb):
    stem = verb[:-1] if verb.endswith("e") else verb
    doubled = stem + stem[-1]
    forms = {stem + "ed", stem + "ing", doubled + "ed", doubled + "ing"}
    if re.search("[^aeiou]y$", verb):
        forms |= {verb[:-1] + "ies", verb[:-1] + "ied"}
    return forms | {verb + "s", verb + "es"}


NOT_IMPERATIVE = set().union(*(_forms(verb) for verb in VERBS)) - set(VERBS)


def faults(subject):
    """What is wrong with a subject, as phrases."""
    if re.match(r'Revert ".*"$', subject):
        return
    if len(subject) > LIMIT:
        yield f"{len(subject)} characters, at most {LIMIT}"
    if subject.endswith("."):
        yield "a period at the end"
    area = AREA.match(subject)
    if not area:
        yield 'no area: write "area: imperative ..."'
        return
    first = re.match(r"[\w'-]*", subject[area.end() :]).group().lower()
    if first in NO_VERB or first in NOT_IMPERATIVE:
        yield f"'{first}' is no imperative"


def check(tree):
    base = tree.base()
    if not base:
        tree.skip("commits", "no history to compare with")
        return
    for name, parents, day, subject in tree.commits(base):
        if day < FIRST_DAY:
            continue
        for fault in faults(subject):
            if parents > 1:
                tree.warnings.append(f"merge {name}: {fault}: {subject}")
            else:
                yield Breach(f"commit {name}", 1, f"{fault}: {subject}")
