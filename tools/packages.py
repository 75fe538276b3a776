#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes version and address into the files of packages, each of which needs them in its own syntax.

The version is that of include/gnomon/version.hpp, the address that of packaging/address.

    packages.py              writes the files in the repository
    packages.py --check      compares them with what would be written, and with CHANGELOG.md
    packages.py --version    prints the version

Exit status: 0, or 1 with --check if a file differs.
"""

import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def read_version(root):
    """MAJOR.MINOR.PATCH of the header."""
    header = (root / "include/gnomon/version.hpp").read_text(encoding="utf-8")
    return ".".join(re.findall(r"^#define GNOMON_VERSION_\w+ (\d+)$", header, re.M))


def read_address(root):
    """The values of packaging/address by their names."""
    text = (root / "packaging/address").read_text(encoding="utf-8")
    return dict(re.findall(r"^(\w+) =[ ]*(.*)$", text, re.M))


def rules(version, address):
    """(file, pattern, text): each pattern has one match in its file, which is to be the text."""
    homepage, mail, maintainer = address["homepage"], address["mail"], address["maintainer"]
    page = homepage and f"Homepage: {homepage}\n"
    return [
        ("CITATION.cff", r"^version: .*\n", f"version: {version}\n"),
        ("package.xml", r"<version>.*</version>", f"<version>{version}</version>"),
        ("package.xml", r"<maintainer .*</maintainer>",
         f'<maintainer email="{mail}">{maintainer}</maintainer>'),
        ("package.xml", r"^(  <url .*\n)?  <license ",
         (homepage and f'  <url type="website">{homepage}</url>\n') + "  <license "),
        ("packaging/vcpkg/gnomon/vcpkg.json", r'^  "version": .*\n', f'  "version": "{version}",\n'),
        ("packaging/vcpkg/gnomon/vcpkg.json", r'^(  "homepage": .*\n)?  "license"',
         (homepage and f'  "homepage": "{homepage}",\n') + '  "license"'),
        ("packaging/vcpkg/gnomon/portfile.cmake", r"^set\(releases .*\n",
         f'set(releases "{address["releases"]}")\n'),
        ("packaging/conan/conandata.yml", r'^  "[\d.]+":$', f'  "{version}":'),
        ("packaging/conan/conandata.yml", r"^    releases: .*$", f'    releases: "{address["releases"]}"'),
        ("packaging/conan/conanfile.py", r"^    homepage = .*$", f"    homepage = {homepage or None!r}"),
        ("packaging/debian/changelog", r"\Agnomon \(.*?\)", f"gnomon ({version}-1)"),
        ("packaging/debian/changelog", r"^ -- .* <.*>", f" -- {maintainer} <{mail}>"),
        ("packaging/debian/control", r"^Maintainer: .*\n", f"Maintainer: {maintainer} <{mail}>\n"),
        ("packaging/debian/control", r"^(Homepage: .*\n)?Rules-", page + "Rules-"),
        ("packaging/debian/copyright", r"^Upstream-Contact: .*\n",
         f"Upstream-Contact: {maintainer} <{mail}>\n"),
        ("tests/consumer/find_package/CMakeLists.txt", r"find_package\(gnomon [\d.]+",
         f"find_package(gnomon {version.rpartition('.')[0]}"),
    ]


def written(root):
    """(file, its text, the text that it should have), for each file of the rules."""
    texts = {}
    for name, pattern, text in rules(read_version(root), read_address(root)):
        before, now = texts.get(name) or [(root / name).read_text(encoding="utf-8")] * 2
        now, matches = re.subn(pattern, lambda _, text=text: text, now, flags=re.M)
        if matches != 1:
            sys.exit(f"{name}: {matches} matches of {pattern}, not 1")
        texts[name] = before, now
    return [(name, *both) for name, both in texts.items()]


def main():
    parser = argparse.ArgumentParser(description="Writes version and address into files of packages.")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--version", action="store_true")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT)
    options = parser.parse_args()

    version = read_version(options.root)
    if options.version:
        print(version)
        return 0
    problems = [name for name, before, now in written(options.root) if before != now]
    if options.check:
        changes = (options.root / "CHANGELOG.md").read_text(encoding="utf-8")
        for name in problems:
            print(f"{name}: not version {version} or the address of packaging/address")
        if not re.search(rf"^## \[{re.escape(version)}\]", changes, re.M):
            problems.append("CHANGELOG.md")
            print(f"CHANGELOG.md: has no section of version {version}")
        return 1 if problems else 0
    for name, before, now in written(options.root):
        if before != now:
            (options.root / name).write_text(now, encoding="utf-8")
            print(f"{name}: written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
