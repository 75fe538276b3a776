# SPDX-License-Identifier: BSL-1.0
"""The public names of the library, and where doxygen describes them."""

import dataclasses
import pathlib
import re
import sys
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))

from cpp_source import (INCLUDE_DIR, KINDS, TYPES, blank, code_only, end_of_bracket, is_friend,
                        namespace_at, tags)


@dataclasses.dataclass(frozen=True)
class Name:
    full: str     # with namespaces
    kind: str     # as ctags calls it, or "concept"
    header: str   # relative to include/

    @property
    def short(self):
        return self.full.rpartition("::")[2]


def is_in_function(header, line):
    """Whether a line of a header is within braces that are no namespace's: of some functions ctags takes
    the local variables for those of a namespace."""
    code = code_only((INCLUDE_DIR / header).read_text(encoding="utf-8")).split("\n")
    depths = []
    for brace in re.finditer(r"\bnamespace\s+[\w:]+\s*\{|[{}]", "\n".join(code[:line - 1])):
        if brace[0] == "}":
            depths.pop()
        else:
            depths.append(brace[0] != "{")
    return not all(depths)


def public_names():
    """The types, functions, variables and concepts of namespace gnomon and the namespaces in it, without
    those named detail, by full name: what public_names.py counts, and what is in simulation, io,
    recognition and the adapters."""
    found = {}
    for tag in tags(INCLUDE_DIR):
        scope, name = tag.get("scope", ""), tag["name"]
        if tag.get("scopeKind") != "namespace" or not re.match(r"gnomon(::|$)", scope):
            continue
        if "detail" in scope.split("::") or "/detail/" in tag["path"] or tag["kind"] not in KINDS:
            continue
        if name.startswith(("operator", "__anon")) or is_friend(INCLUDE_DIR, tag):
            continue
        if is_in_function(tag["path"], tag["line"]):
            continue
        here = Name(f"{scope}::{name}", tag["kind"], tag["path"])
        known = found.get(here.full)
        if known is None or (known.kind not in TYPES and here.kind in TYPES):
            found[here.full] = here
    for header in sorted(INCLUDE_DIR.rglob("*.hpp")):
        path, code = header.relative_to(INCLUDE_DIR).as_posix(), code_only(header.read_text("utf-8"))
        for concept in re.finditer(r"\bconcept\s+(\w+)\s*=", code):
            scope = namespace_at(code, concept.start())
            if "detail" not in scope.split("::") and "/detail/" not in path:
                found[f"{scope}::{concept[1]}"] = Name(f"{scope}::{concept[1]}", "concept", path)
    return found


class Reference:
    """What a tag file of doxygen says about addresses of pages."""

    def __init__(self, tagfile):
        self.headers, self.compounds, self.of_header = {}, {}, {}
        for compound in xml.etree.ElementTree.parse(tagfile).getroot():
            page = compound.findtext("filename")
            if compound.get("kind") == "file":
                path = compound.findtext("path") + compound.findtext("name")
                header = path.rpartition("/include/")[2]
                self.headers[header] = page
            elif compound.get("kind") in ("class", "struct", "concept", "namespace"):
                self.compounds[compound.findtext("name")] = page
                header = compound.findtext("name") if compound.get("kind") == "namespace" else None
            else:
                continue
            for member in compound.findall("member") if header else ():
                address = f"{member.findtext('anchorfile')}#{member.findtext('anchor')}"
                self.of_header.setdefault((header, member.findtext("name")), address)

    def address(self, name):
        """The page of a Name, with its anchor, or None."""
        space, _, short = name.full.rpartition("::")
        return (self.compounds.get(name.full) or self.of_header.get((name.header, short))
                or self.of_header.get((space, short)))
