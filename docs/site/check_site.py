#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Checks the built site: every link within it leads to a page, and to an anchor if it names one; every
public name of the library is CLICKS clicks from the start page or fewer, without the menus, which are
made by a script; and the search knows each.

    check_site.py SITE TAGS
"""

import collections
import html.parser
import pathlib
import re
import sys
import urllib.parse

from reference import Reference, public_names

CLICKS = 3


class Page(html.parser.HTMLParser):
    """The links of a page and its anchors."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = set(), set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.anchors |= {attributes[key] for key in ("id", "name") if attributes.get(key)}
        for key in ("href", "src"):
            if attributes.get(key):
                self.links.add(attributes[key])


def targets(page, links):
    """(file, anchor) of each link that stays on the site."""
    for link in links:
        address = urllib.parse.urlsplit(link)
        if not address.scheme and not link.startswith(("//", "javascript:")):
            yield urllib.parse.unquote(address.path) or page, urllib.parse.unquote(address.fragment)


def main():
    site, tagfile = pathlib.Path(sys.argv[1]), sys.argv[2]
    pages = {file.name: Page(file) for file in sorted(site.glob("*.html"))}
    problems, links = [], 0
    for name, page in pages.items():
        for file, anchor in targets(name, page.links):
            links += 1
            if not (site / file).is_file():
                problems.append(f"{name}: no file {file}")
            elif anchor and file in pages and anchor not in pages[file].anchors:
                problems.append(f"{name}: no anchor {file}#{anchor}")

    clicks, waiting = {("index.html", ""): 0}, collections.deque(["index.html"])
    read = {"index.html"}
    while waiting:
        name = waiting.popleft()
        for file, anchor in targets(name, pages[name].links):
            for target in ((file, anchor), (file, "")):
                clicks.setdefault(target, clicks[name, ""] + 1)
            if file in pages and file not in read:
                read.add(file)
                waiting.append(file)

    searched = set()
    for index in (site / "search").glob("all_*.js"):
        searched |= set(re.findall(r"^\s*\['[^']*',\['([^']*?)'", index.read_text("utf-8"), re.M))
    reference, by_clicks = Reference(tagfile), collections.Counter()
    for name in public_names().values():
        address = reference.address(name)
        if address is None:
            problems.append(f"{name.header}: {name.full} is described nowhere")
            continue
        file, _, anchor = address.partition("#")
        count = clicks.get((file, anchor))
        by_clicks[count] += 1
        if count is None or count > CLICKS:
            problems.append(f"{name.full}: {count} clicks from the start page, at most {CLICKS}")
        if name.short not in searched:
            problems.append(f"{name.full}: the search does not know it")

    for problem in problems:
        print(problem)
    by_count = ", ".join(f"{by_clicks[n]} of {n} clicks" for n in sorted(by_clicks, key=str))
    print(f"{len(pages)} pages, {len(read)} reached from the start page; {links} links; "
          f"{sum(by_clicks.values())} public names: {by_count}; {len(problems)} problems")
    sys.exit(1 if problems else 0)


main()
