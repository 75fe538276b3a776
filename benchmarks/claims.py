# SPDX-License-Identifier: BSL-1.0
"""Claims of the thesis, which the relations.py of a chapter enters and its page tests.

Each claim is a function of the tables of its program, {table: rows}, that returns (the measured
values as text, whether the claim holds).
"""

CLAIMS = []


def relation(program, id, claim, thesis, why=""):
    """Registers a claim about the measurements of a program; `why` explains one that does not hold."""
    def enter(judge):
        CLAIMS.append({"program": program, "id": id, "claim": claim, "thesis": thesis,
                       "why": why, "judge": judge})
        return judge
    return enter


def judged(tables):
    """The relations of the measured programs with their verdicts."""
    verdicts = []
    for c in CLAIMS:
        if c["program"] not in tables:
            continue
        measured, holds = c["judge"](tables[c["program"]])
        verdicts.append({**{key: c[key] for key in ("program", "id", "claim", "thesis")},
                         "measured": measured, "holds": bool(holds),
                         "why": "" if holds else c["why"]})
    return verdicts
