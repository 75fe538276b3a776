#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Corrects pages that doxygen wrote:

    finish.py SITE TAGS

- The line with the include of a type links the page of its header, which has the idea and its sources.
- The definition of a concept links its page with laws and models.
- Of types whose nested types are private, doxygen links a list of these that it does not print.
"""

import pathlib
import re
import sys

from reference import Reference

LIST = re.compile(r'<a href="#nested-classes">Classes</a> *(?:&#124; *)?')
INCLUDE = re.compile(r"<code>#include &lt;([\w/.]+)&gt;</code>")


def main():
    headers = Reference(sys.argv[2]).headers
    for page in pathlib.Path(sys.argv[1]).glob("*.html"):
        text = page.read_text(encoding="utf-8")
        corrected = INCLUDE.sub(lambda found: f'<a href="{headers[found[1]]}">{found[0]}</a>'
                             if found[1] in headers else found[0], text)
        if 'name="nested-classes"' not in corrected:
            corrected = LIST.sub("", corrected)
        concept = re.match(r"conceptgnomon_1_1(?:\w+_1_1)?(\w+)\.html", page.name)
        laws = concept and f"concepts-{concept[1].replace('__', '_')}.html"
        if laws and (page.parent / laws).exists():
            corrected = corrected.replace('<div class="contents">', f'<div class="contents">\n<p><a href="{laws}">'
                                          "Intuition, laws and models</a></p>", 1)
        if corrected != text:
            page.write_text(corrected, encoding="utf-8")


main()
