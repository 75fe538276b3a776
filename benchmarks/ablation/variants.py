# SPDX-License-Identifier: BSL-1.0
"""The variants of the default chain: without one of its steps, or with another constant."""

import dataclasses
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # in a folder of sources
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import constants  # noqa: E402

FACTORS = (0.8, 1.25)
# Headers of the default chain in other folders than those of constants.py: their named numbers.
OPTIONS = ["gnomon/neighborhoods/noise_knn.hpp"]
# Whole numbers that must be multiples of another one.
MULTIPLES = {"boundary_pairs": 2, "pairs": 2}

# Each step, and how to leave it out: options of score.cpp, or texts to replace in headers, each of
# which occurs once: (header, text, new text).
STEPS = {
    "merging behind occluders": {"options": ["--without", "merging"]},
    "closing of narrow gaps": {"options": ["--without", "narrow_gaps"]},
    "measured noise, 15 mm instead": {"options": ["--noise", "15"]},
    "measured noise, the true one instead": {"options": ["--noise", "true"]},
    "noise of wide planes": {"texts": [
        ("gnomon/perception/detail/known_noise.hpp",
         "noise_of_wide_planes(points, *found.curve, result.memory.sparse, run);", "*found.curve;")]},
    "cells, each point its own": {"texts": [
        ("gnomon/perception/detail/cell_surfaces.hpp",
         "return std::max(noise.of_planes.along(ray), least);", "return least;")]},
    "second growth, by twice the angle": {"texts": [
        ("gnomon/segmentation/segment_planes.hpp", "    regions.grow(surface, std::max(0.0, 2.0 * cosine * cosine - 1.0), run);  // of twice the angle\n", "")]},
    "cutting of regions at edges": {"texts": [
        ("gnomon/segmentation/detail/plane_regions.hpp",
         "    void cut_edges(const X& run) {\n", "    void cut_edges(const X& run) {\n        return;\n")]},
    "cutting of regions at creases": {"texts": [
        ("gnomon/segmentation/segment_planes.hpp",
         "    if (noise_is_independent) regions.cut_creases(run);\n", "")]},
    "no merging of planes at edges": {"texts": [
        ("gnomon/segmentation/detail/plane_comparison.hpp",
         "    if (are_at_edge(a, b)) return std::numeric_limits<double>::infinity();\n", "")]},
    "merging of neighboring planes": {"texts": [
        ("gnomon/segmentation/detail/plane_regions.hpp",
         "bool merge(scratch<region_pair> pairs) {",
         "bool merge(scratch<region_pair> pairs) { pairs.clear();")]},
    "competition of planes for cells": {"texts": [
        ("gnomon/segmentation/detail/plane_regions.hpp",
         "for (int round = 0; round < most_rounds; ++round) {\n            region_edges<> edges;",
         "for (int round = 0; false; ++round) {\n            region_edges<> edges;")]},
    "weights of cells by their points": {"texts": [
        ("gnomon/perception/detail/cell_surfaces.hpp", "        cloud_->counts = cells_.counts;\n", "")]},
    "competition of planes for points": {"texts": [
        ("gnomon/perception/detail/cell_surfaces.hpp",
         "competition.begin(graph[c], of_cells, of_cells[c]);", "labels[i] = of_cells[c]; continue;")]},
}


@dataclasses.dataclass(frozen=True)
class Variant:
    kind: str              # "default", "step", or that of a constant: "chosen", "thesis", "option"
    what: str              # the step or the constant
    place: str = ""        # of the constant
    value: str = ""        # "as it is -> as it is here"
    factor: float = 1.0    # of the constant
    options: tuple = ()    # of score.cpp
    texts: tuple = ()      # (header, text, new text), each of which occurs once
    number: tuple = ()     # (header, line, column, number, new number)

    @property
    def is_compiled(self):
        """Whether it has a library of its own."""
        return not self.options

    def headers(self, include):
        """{header: its text in this variant}. @throws ValueError if a text does not occur once."""
        changed = {}
        for header, text, new in self.texts:
            before = changed.get(header) or (include / header).read_text(encoding="utf-8")
            if before.count(text) != 1:
                raise ValueError(f"variants.py: without '{self.what}': include/{header} has "
                                 f"{before.count(text)} times '{text}'")
            changed[header] = before.replace(text, new)
        if self.number:
            header, line, column, number, new = self.number
            lines = (include / header).read_text(encoding="utf-8").split("\n")
            start, end = lines[line - 1][:column - 1], lines[line - 1][column - 1:]
            if not end.startswith(number):
                raise ValueError(f"variants.py: include/{header}:{line} has no {number}")
            lines[line - 1] = start + new + end.removeprefix(number)
            changed[header] = "\n".join(lines)
        return changed


def scaled(number, factor, step=1):
    """A number of the code times a factor. Whole ones are rounded, and change by one step at least."""
    digits = number.replace("'", "")
    if not digits.isdigit():
        text = f"{float(digits) * factor:.12g}"
        return text if re.search(r"[.e]", text) else text + ".0"
    whole = int(digits)
    new = step * round(whole * factor / step)
    if new == whole:
        new += step if factor > 1 else -step
    return str(new)


def steps():
    for what, how in STEPS.items():
        yield Variant("step", what, options=tuple(how.get("options", ())),
                      texts=tuple(how.get("texts", ())))


def other_constants(include):
    """The named numbers of OPTIONS, as constants of kind "option"."""
    for path in OPTIONS:
        header = constants.Header(path, (include / path).read_text(encoding="utf-8"))
        for c in header.constants():
            if c.name and c.kind != "formula":
                yield dataclasses.replace(c, kind="option")


def of_constants(include):
    found = [c for c in constants.constants(include) if c.name and c.kind in ("chosen", "thesis")]
    for c in [*found, *other_constants(include)]:
        for factor in FACTORS:
            new = scaled(c.value, factor, MULTIPLES.get(c.name, 1))
            unit = f" {c.unit}" if c.unit else ""
            yield Variant(c.kind, c.name, c.place, f"{c.value} -> {new}{unit}", factor,
                          number=(c.path, c.line, c.column, c.value, new))


def all_variants(include):
    """The default, and all variants of it. @throws ValueError if a header does not have what one
    changes."""
    found = [Variant("default", "default"), *steps(), *of_constants(include)]
    for variant in found:
        variant.headers(include)
    return found


def few_of_each_kind(variants):
    """The default, a step by options, a step by texts, and a constant of each kind of constants.py."""
    kinds = {}
    for v in variants:
        if v.kind != "option":
            kinds.setdefault((v.kind, v.is_compiled), v)
    return list(kinds.values())
