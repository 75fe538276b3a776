#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes the pages of the site for doxygen: those of docs/ with links that lead to pages of the site, a
start page from README.md, a page for each floor from its headers, and sources that pages link.

    make_pages.py TAGS HEADERS PAGES SITE

TAGS is a tag file of doxygen for the headers alone; from it come the addresses of names. In the comments
of HEADERS, the copies that header_filter.py made, names in `backticks` become links. Pages go to the
folder PAGES, pictures and other files that pages link to SITE/files.
"""

import os
import pathlib
import re
import shutil
import sys

from reference import INCLUDE_DIR, ROOT, Reference, public_names

START = "README.md"
# (folder, title): the order is that of the table in README.md.
PICTURES = {
    "normals": ("docs/normal_uncertainty.png", "A kitchen, colored by the standard deviation of its normals"),
    "segmentation": ("docs/lms400_table.png", "Planes of a scan of a table"),
    "occlusion": ("docs/kitchen_segments.png", "Surfaces of a kitchen: black lines cross gaps that were closed"),
    "perception": ("docs/office_kinect.png", "Surfaces of an office, seen by a depth camera"),
    "recognition": ("docs/recognized_room.png", "Desks of a room, recognized"),
    "simulation": ("docs/kitchen_truth.png", "A simulated kitchen, object by object"),
    "features": ("docs/measured_room.png", "A floor plan from boxes, outlines and openings of planes"),
}
# Where to read on, by floor.
PAGES = {
    "core": ["docs/concepts/point.md", "docs/concepts/point_range.md", "docs/concepts/execution.md",
             "docs/concepts/range_noise.md"],
    "neighborhoods": ["docs/concepts/neighborhood.md", "docs/concepts/neighborhood_graph.md",
                      "docs/concepts/size_preference.md"],
    "filters": ["docs/coming-from.md", "examples/clean_and_thin.cpp"],
    "normals": ["docs/normals.md", "docs/concepts/estimator.md", "docs/in-a-result.md"],
    "features": ["docs/concepts/curvature_estimator.md", "docs/concepts/descriptor.md",
                 "docs/in-a-result.md"],
    "segmentation": ["docs/surfaces.md", "docs/in-a-result.md", "docs/concepts/oriented_dissimilarity.md"],
    "occlusion": ["docs/surfaces.md", "docs/concepts/merge_policy.md"],
    "perception": ["docs/surfaces.md", "docs/in-a-result.md", "docs/questions.md"],
    "recognition": ["docs/recognition.md", "docs/concepts/part_feature.md",
                    "docs/concepts/part_relation.md", "docs/concepts/view_likelihood.md"],
    "simulation": ["docs/simulation.md", "docs/concepts/shape.md", "docs/concepts/ray_caster.md",
                   "docs/concepts/sensor_trajectory.md"],
    "io": ["docs/formats.md", "docs/coming-from.md"],
    "adapters": ["docs/formats.md", "docs/packages.md", "docs/simulation.md", "docs/recognition.md"],
}
ADAPTERS = "what do other libraries give and take?"

# Names that are those of members as a rule, where pages name them alone.
MEMBERS = {"radius", "columns", "rows"}

FENCE = re.compile(r"^```(?P<language>[^\n]*)\n(?P<code>.*?)^```$", re.M | re.S)
LINK = re.compile(r"(?P<image>!?)\[(?P<text>(?:[^\[\]]|\[[^\]]*\])*)\]\((?P<target>[^()\s]+)\)")
SPAN = re.compile(r"`([^`\n]+)`")


def slug(heading):
    """The anchor that GitHub gives to a heading."""
    text = re.sub(r"[`*]|\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def page_id(path):
    """The name of the page of a file: docs/concepts/point.md is concepts-point."""
    return re.sub(r"[^\w]+", "-", re.sub(r"^docs/|\.md$", "", path))


class Site:
    def __init__(self, tagfile, pages, site):
        self.reference, self.pages, self.site = Reference(tagfile), pathlib.Path(pages), pathlib.Path(site)
        self.names = public_names()
        self.short = {}
        # A short name that several namespaces have is that of gnomon.
        for name in sorted(self.names.values(), key=lambda n: -n.full.count("::")):
            if self.reference.address(name) and name.short not in MEMBERS:
                self.short[name.short] = self.reference.address(name)
        for name in self.names.values():
            if self.reference.address(name):
                self.short[name.full] = self.reference.address(name)
                self.short[name.full.removeprefix("gnomon::")] = self.reference.address(name)
        self.sources = []

    def address(self, target, base):
        """The address on the site of a link in a file in the folder `base`; None for a folder that has
        no page."""
        if re.match(r"\w+:", target):
            return target
        file, _, anchor = target.partition("#")
        path = os.path.normpath(os.path.join(base, file)) if file else None
        if path == "docs/concepts":
            return "concept-pages.html"
        if path == START:
            return "index.html"
        if path and (ROOT / path).is_dir() or not (ROOT / path).exists():
            return None
        header = path.removeprefix("include/")
        if header in self.reference.headers:
            return self.reference.headers[header]
        if path.endswith(".md"):
            page = page_id(path)
            return f"{page}.html" + (f"#{page}-{anchor}" if anchor else "")
        if path.endswith((".cpp", ".hpp")):
            if path not in self.sources:
                self.sources.append(path)
            return f"{page_id(path)}.html"
        target = self.site / "files" / path
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / path, target)
        return f"files/{path}"

    def title(self, target, base):
        """What a link says that on GitHub is the path of a page: its title, or the path."""
        path = ROOT / os.path.normpath(os.path.join(base, target.partition("#")[0]))
        if path.suffix != ".md":
            return "concepts" if path.name == "concepts" else path.relative_to(ROOT).as_posix()
        title = re.search(r"^# (.*)$", path.read_text(encoding="utf-8"), re.M)[1]
        return title if title.startswith("`") else f"*{title}*"

    def line(self, text, base, page=None):
        """Markdown with links to the site."""
        parts = []

        def keep(html):
            parts.append(html)
            return f"\0{len(parts) - 1}\0"

        def code(span):
            text = span[1].replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
            # What doxygen would read as a command, a link or emphasis.
            return "<code>" + re.sub(r"::|[@%#*\\]", lambda c: "\\" + c[0], text) + "</code>"

        def name(span):
            called = re.match(r"([\w:]+)(<.*>)?([({].*[)}])?$", span[1])
            known = self.short.get(called[1]) if called else None
            return keep(f'<a href="{known}">{code(span)}</a>' if known else span[0])

        def link(found):
            target = found["target"]
            if target.startswith("#"):
                address = f"#{page}-{target[1:]}"
            else:
                address = self.address(target, base)
            text = SPAN.sub(code, self.title(target, base) if found["text"] in target else found["text"])
            if address is None:
                return text
            if found["image"]:
                return keep(f'<a href="{address}"><img src="{address}" alt="{text}" class="picture"/></a>')
            return keep(f'<a href="{address}">{text}</a>')

        text = SPAN.sub(name, LINK.sub(link, text))
        while "\0" in text:
            text = re.sub("\0(\\d+)\0", lambda place: parts[int(place[1])], text)
        return text

    def markdown(self, text, path, page=None):
        """A page of the repository as one of the site."""
        page, base, out, last = page or page_id(path), os.path.dirname(path), [], 0
        text = re.sub(r"<!--.*?-->\n?", "", text, flags=re.S)

        def prose(part):
            lines = []
            for line in self.line(re.sub(r"^(#+ .*)$", lambda h: h[1].replace("`", ""), part, flags=re.M),
                                  base, page).split("\n"):
                heading = re.match(r"(#+) (.*)$", line)
                if heading and len(heading[1]) == 1:
                    line = f"# {heading[2]} {{#{page}}}"
                elif heading:
                    line = f"{line} {{#{page}-{slug(heading[2])}}}"
                lines.append(line)
            return "\n".join(lines)

        for block in FENCE.finditer(text):
            out += [prose(text[last:block.start()]), fenced(block["language"], block["code"])]
            last = block.end()
        return "".join(out + [prose(text[last:])])

    def write(self, page, text):
        (self.pages / f"{page}.md").write_text(text + "\n", encoding="utf-8")

    def link_to(self, path):
        title = re.search(r"^# (.*)$", (ROOT / path).read_text(encoding="utf-8"), re.M)
        text = title[1].replace("`", "") if path.endswith(".md") and title else path
        return f'<a href="{self.address(path, "")}">{text}</a>'


def fenced(language, code):
    language = {"cpp": "{.cpp}", "c++": "{.cpp}", "cmake": "", "python": "{.py}"}.get(language, "")
    return f"~~~{language}\n{code}~~~"


def section(text, heading):
    """The text under a heading of README.md."""
    return re.search(rf"^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", text, re.M | re.S)[1]


def first_sentence(header):
    """What the comment at the top of a header begins with, as one line."""
    comment = re.search(r"^/// @file\n((?:///[^\n]*\n)+)", (INCLUDE_DIR / header).read_text("utf-8"), re.M)
    paragraph = re.split(r"\n\s*\n", re.sub(r"^///[ ]?", "", comment[1], flags=re.M))[0]
    text = " ".join(paragraph.split())
    return re.split(r"(?<=[a-z\)\`\]])[.:](?= |$)", text)[0].rstrip(".:") + "."


def floors(readme):
    """(floor, question, cell of its headers) of each row of the table in README.md."""
    table = section(readme, "What it holds")
    rows = [[cell.strip() for cell in row.strip("|").split(" | ")] for row in table.split("\n")
            if row.startswith("| ")][1:]
    return [(name, question, held) for name, question, held in rows] + [("adapters", ADAPTERS, "")]


def floor_page(site, floor, question, held):
    headers = sorted(header for header in site.reference.headers
                     if header.startswith(f"gnomon/{floor}/") and header != f"gnomon/{floor}.hpp")
    umbrella = f"gnomon/{floor}.hpp"
    lines = [f"# {floor.capitalize()}: {question} {{#floor-{floor}}}", ""]
    if umbrella in site.reference.headers:
        lines += [first_sentence(umbrella), "", f'~~~{{.cpp}}\n#include <{umbrella}>\n~~~', ""]
    if held:
        lines += ["Holds " + site.line(held, "") + ".", ""]
    if floor in PICTURES:
        lines += [site.line(f"![{PICTURES[floor][1]}]({PICTURES[floor][0]})", ""), "",
                  f"*{PICTURES[floor][1]}.*", ""]
    lines += ["Read on: " + ", ".join(site.link_to(path) for path in PAGES[floor]) + ".", ""]
    rows = []
    for header in headers:
        names = sorted({name.full: name for name in site.names.values() if name.header == header}.items())
        links = ", ".join(f'<a href="{site.reference.address(name)}"><code>{name.short}</code></a>'
                          for _, name in names if site.reference.address(name))
        about = site.line(first_sentence(header).replace("*", ""), "")
        file = header.rpartition("/")[2]
        rows.append([f'<a href="{site.reference.headers[header]}">{file}</a>', about, links])
    lines.append(html_table(rows, ["header", "what it is about", "names"]))
    site.write(f"floor-{floor}", "\n".join(lines))


def html_table(rows, heads):
    """A table that becomes a list on a phone."""
    def cells(row, tag):
        return "".join(f"<{tag}>{cell}</{tag}>" for cell in row)
    return "\n".join(['<table class="floor">', f"<tr>{cells(heads, 'th')}</tr>"]
                     + [f"<tr>{cells(row, 'td')}</tr>" for row in rows] + ["</table>"])


def start_page(site, readme):
    rows = [(name, question) for name, question, _ in floors(readme)]
    intro = readme[:readme.index("## Two commands")].split("\n", 1)[1]
    table = re.search(r"^\| I want to .*?\n\n", readme, re.M | re.S)[0].strip().split("\n")
    wishes = [[site.line(cell.strip(), "") for cell in row.strip("|").split(" | ")] for row in table[2:]]
    lines = ["# gnomon {#mainpage}", site.line(intro, ""), "", "## Two commands {#commands}",
             site.line(section(readme, "Two commands"), ""),
             "## Where to go {#where-to-go}", "", html_table(wishes, ["I want to", ""]), "",
             "## What it holds {#what-it-holds}", "",
             html_table([[f'<a href="floor-{name}.html">{name}</a>', question] for name, question in rows],
                        ["floor", "what it answers"])]
    lines += ["", "Dependencies go one way, upwards in this table.", "", "## Pages {#site-pages}", ""]
    for path in ("docs/in-a-result.md", "docs/questions.md", "docs/coming-from.md", "docs/gallery.md",
                 "docs/terms.md", "docs/formats.md", "docs/packages.md", "docs/platforms.md", "docs/versions.md",
                 "docs/results.md", "docs/thesis-notes.md", "CHANGELOG.md"):
        lines.append(f"- {site.link_to(path)}")
    lines += ['- <a href="concept-pages.html">Concepts</a>: the policies that can be your own, with their laws',
              '- <a href="annotated.html">All types</a>, <a href="files.html">all headers</a>, '
              '<a href="pages.html">all pages</a>',
              "", "## In every call {#every-call}", "",
              "The order of arguments is the same everywhere: points, neighborhood or graph, surface, "
              "segments, policy and options, execution, projection. "
              + site.line("`run`, the execution, is `{}` for one thread, `threads{}` for all cores or "
                          "`threads{n}`; `projection` maps an element of the range to a point.", "")]
    site.write("index", "\n".join(lines))


def concept_list(site):
    lines = ["# Concepts {#concept-pages}", "",
             "What an algorithm demands of its arguments, and of the policies that you may replace.", "",
             "| concept | intuition |", "|---|---|"]
    for page in sorted((ROOT / "docs/concepts").glob("*.md")):
        text = page.read_text(encoding="utf-8")
        intuition = " ".join(re.search(r"## Intuition\n\n(.*?)\n\n", text, re.S)[1].split())
        first = re.split(r"(?<=[.:]) ", intuition)[0].rstrip(":.") + "."
        path = page.relative_to(ROOT).as_posix()
        lines.append(f"| \\subpage {page_id(path)} | {site.line(first, 'docs/concepts')} |")
    site.write("concept-pages", "\n".join(lines))


def list_of_pages(site, pages, rows):
    """Pages above the others: the menu at the side shows what is in them."""
    parts = {
        "floors": ("By floor", [f"floor-{name}" for name, _ in rows]),
        "guides": ("Guides", [page_id(path) for path in pages if re.match(r"docs/[^/]*$", path)]),
        "results-pages": ("Results", [page_id(path) for path in pages if "/results/" in path]),
        "sources": ("Sources that pages link", [page_id(path) for path in sorted(site.sources)]),
    }
    for page, (title, children) in parts.items():
        items = "\n".join(f"- \\subpage {child}" for child in children)
        site.write(page, f"# {title} {{#{page}}}\n\n{items}")


def with_links(text, site):
    """A header with links in its comments, but for blocks of code and names of members in it."""
    def member(name):
        return re.compile(rf"(?<!\bconcept)(?<!\busing)(?<=[\w>&*\]]) {name}(?: = [^;]*|\{{[^;]*)?;")

    def link(span):
        name = span[1]
        if name not in site.short or member(name).search(text):
            return span[0]
        return f'<a href="{site.short[name]}"><code>{name}</code></a>'

    def comment(line):
        return line[0] if line[1] else re.sub(r"`(\w+)`", link, line[0])
    return re.sub(r"///<?(     )?.*$", comment, text, flags=re.M)


def side_by_side(text):
    """Code under names in bold, one after another, as columns."""
    block = r"\*\*[^*\n]+\*\*\n\n~~~[^\n]*\n.*?\n?~~~\n+"

    def columns(run):
        cells = re.findall(block, run[0] + "\n", re.S)
        return ('<table class="side-by-side"><tr>\n'
                + "".join(f"<td>\n\n{cell}\n</td>\n" for cell in cells) + "</tr></table>\n\n")
    return re.sub(rf"(?:{block}){{2,}}", columns, text, flags=re.S)


def main():
    site = Site(sys.argv[1], *sys.argv[3:5])
    for header in pathlib.Path(sys.argv[2]).rglob("*.hpp"):
        header.write_text(with_links(header.read_text(encoding="utf-8"), site), encoding="utf-8")
    site.pages.mkdir(parents=True, exist_ok=True)
    readme = (ROOT / START).read_text(encoding="utf-8")
    start_page(site, readme)
    rows = floors(readme)
    for floor, question, held in rows:
        floor_page(site, floor, question, held)
    concept_list(site)
    pages = ["CHANGELOG.md"] + [page.relative_to(ROOT).as_posix() for page in sorted((ROOT / "docs").rglob("*.md"))]
    for path in pages:
        text = site.markdown((ROOT / path).read_text(encoding="utf-8"), path)
        site.write(page_id(path), side_by_side(text))
    for path in site.sources:
        code = (ROOT / path).read_text(encoding="utf-8")
        site.write(page_id(path), f"# {path} {{#{page_id(path)}}}\n\n{fenced('cpp', code)}")
    list_of_pages(site, pages, [(name, question) for name, question, _ in rows])


main()
