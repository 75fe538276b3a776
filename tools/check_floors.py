#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Keeps the floors of include/gnomon apart.

A header sees its own floor and the floors below; simulation and io see core alone. Umbrellas
contain includes only: gnomon/<floor>.hpp every public header of its floor (but the registry, which
needs Boost, and the headers of organized images, shapes, descriptors and of further file formats,
which few need), gnomon.hpp
every umbrella but those of the filters, of recognition and of the simulator. gnomon/perception.hpp, which composes
all floors, is in no umbrella and is included by name. Adapters to other libraries see all floors,
and no header sees them; they have no umbrella. Some foreign headers are kept out, for what they cost
or break. No header includes itself in a circle.
"""

import pathlib
import re
import sys

INCLUDE_DIR = pathlib.Path(__file__).resolve().parent.parent / "include"

# The floors that each floor may see in addition to itself.
BELOW = {
    "core": [],
    "neighborhoods": ["core"],
    "filters": ["core", "neighborhoods"],
    "normals": ["core", "neighborhoods", "filters"],
    "features": ["core", "neighborhoods", "filters", "normals"],
    "segmentation": ["core", "neighborhoods", "filters", "normals", "features"],
    "occlusion": ["core", "neighborhoods", "filters", "normals", "features", "segmentation"],
    "recognition": ["core", "neighborhoods", "filters", "normals", "features", "segmentation",
                    "occlusion"],
    "simulation": ["core"],
    "io": ["core"],
}
BELOW["perception"] = [floor for floor in BELOW if floor not in ("simulation", "io")]
BELOW["adapters"] = [floor for floor in BELOW]

FORBIDDEN = {
    "Eigen/Dense": "include the Eigen modules that are used",
    "Eigen/Eigen": "include the Eigen modules that are used",
    "cmath": "read again by every header; gnomon/core/detail/cmath.hpp reads it once",
    "execution": "does not link where oneTBB's headers are installed",
    "filesystem": "too expensive to compile",
    "nanoflann.hpp": "an oracle and a peer, for tests and benchmarks",
    "iostream": "too expensive to compile; nothing is ever printed",
    "random": "too expensive to compile, and its distributions differ between libraries",
    "ranges": "clang with libstdc++ refuses its views, and too expensive to compile",
    "regex": "too expensive to compile",
}
# Included by name: the registry needs Boost; few users have organized images, or need what describes
# segments and points beyond their curvature.
OUTSIDE = {"gnomon/normals/registry.hpp", "gnomon/neighborhoods/raster.hpp",
           "gnomon/segmentation/segment_image.hpp",
           "gnomon/perception/perceive_views.hpp", "gnomon/perception/find_objects.hpp",
           "gnomon/perception/found_object.hpp", "gnomon/perception/views_of_segments.hpp",
           "gnomon/core/rigid_motion.hpp"}
# To find objects in rooms needs surfaces and visibility, which other recognition does not.
OUTSIDE |= {f"gnomon/recognition/{name}.hpp" for name in ("cast_votes", "part_votes", "surface_model", "verification", "verify_pose",
                                                         "vertical_symmetry")}
OUTSIDE |= {f"gnomon/features/{name}.hpp" for name in (
    "alpha_shape", "convex_hull", "convex_polygon", "minimum_area_rectangle", "minimum_volume_box",
    "project_to_plane", "segment_shape",
    "surface_fit", "fit_sphere", "fit_cylinder", "fit_cone",
    "descriptor", "describe_points", "spin_image", "shape_context", "harmonic_shape_context",
    "zernike_descriptor", "alignment", "align_to_surface")}
# Formats beyond what most scans come in.
OUTSIDE |= {f"gnomon/io/{name}.hpp" for name in ("read_las", "write_las", "write_pcd",
                                                "label_properties")}
# The floors whose umbrellas are included by name; adapters have none.
NOT_IN_GNOMON = {"filters", "perception", "recognition", "simulation", "adapters"}
CMATH_HOME = "gnomon/core/detail/cmath.hpp"

INCLUDE = re.compile(r"^\s*#\s*include\s*[<\"]([^>\"]+)[>\"]", re.M)
NOT_IN_UMBRELLA = re.compile(r"^(?!\s*$|//|#pragma once$|#include <gnomon/[\w/]+\.hpp>$)", re.M)

problems = []


def problem(header, text):
    problems.append(f"include/{header}: {text}")


def floor_of(header):
    """The floor that a header stands on; None for umbrellas and version.hpp."""
    parts = header.split("/")
    return parts[1] if len(parts) > 2 else None


def check_header(header, includes):
    """One header on a floor."""
    floor = floor_of(header)
    if floor not in BELOW:
        problem(header, f"no floor is called '{floor}'")
        return
    for include in includes:
        if include in FORBIDDEN and not (include == "cmath" and header == CMATH_HOME):
            problem(header, f"<{include}>: {FORBIDDEN[include]}")
        elif include.startswith("gnomon/") and include != "gnomon/version.hpp":
            other = floor_of(include)
            if other is None:
                problem(header, f"<{include}> is an umbrella, for users only")
            elif other != floor and other not in BELOW[floor]:
                problem(header, f"<{include}>: {floor} does not see {other}")


def check_umbrella(header, text, includes, wanted):
    """One umbrella: nothing but includes, of all the headers in `wanted`."""
    if NOT_IN_UMBRELLA.search(text):
        problem(header, "an umbrella contains includes only")
    for missing in sorted(wanted - set(includes)):
        problem(header, f"does not include <{missing}>")
    for stranger in sorted(set(includes) - wanted):
        problem(header, f"<{stranger}> is not its own")


def find_circles(graph):
    """Depth-first search for headers that include themselves."""
    done, path = set(), []

    def visit(header):
        if header in path:
            problem(header, "includes itself: " + " > ".join(path[path.index(header):] + [header]))
        elif header not in done:
            path.append(header)
            for include in graph.get(header, []):
                visit(include)
            done.add(path.pop())

    for header in sorted(graph):
        visit(header)


def main():
    texts = {
        file.relative_to(INCLUDE_DIR).as_posix(): file.read_text(encoding="utf-8")
        for file in sorted(INCLUDE_DIR.rglob("*.hpp"))
    }
    graph = {header: INCLUDE.findall(text) for header, text in texts.items()}
    floors = {floor_of(header) for header in texts} - {None}

    for header in texts:
        if floor_of(header):
            check_header(header, graph[header])
    for floor in sorted(floors - {"adapters"}):
        umbrella = f"gnomon/{floor}.hpp"
        public = {h for h in texts
                  if floor_of(h) == floor and "/detail/" not in h and h not in OUTSIDE}
        if umbrella not in texts:
            problem(umbrella, "is missing")
        else:
            check_umbrella(umbrella, texts[umbrella], graph[umbrella], public)
    check_umbrella("gnomon/gnomon.hpp", texts["gnomon/gnomon.hpp"], graph["gnomon/gnomon.hpp"],
                   {f"gnomon/{floor}.hpp" for floor in floors - NOT_IN_GNOMON}
                   | {"gnomon/version.hpp"})
    find_circles(graph)

    for line in problems:
        print(line)
    print(f"{len(texts)} headers on {len(floors)} floors, {len(problems)} problems")
    sys.exit(1 if problems else 0)


main()
