# SPDX-License-Identifier: BSL-1.0
"""The claims of the thesis about features, tested on the measurements.

Each claim is a function of the tables of its program, {table: rows}, that returns (the measured
values as text, whether the claim holds).
"""

from claims import relation


def ranks(values):
    """From 1, the mean rank for equal values."""
    return [sum(v < x for v in values) + (sum(v == x for v in values) + 1) / 2 for x in values]


def rank_correlation(first, second):
    """Spearman's."""
    a, b = ranks(first), ranks(second)
    middle = (len(a) + 1) / 2
    covariance = sum((x - middle) * (y - middle) for x, y in zip(a, b))
    size = sum((x - middle) ** 2 for x in a) * sum((y - middle) ** 2 for y in b)
    return covariance / size ** 0.5 if size > 0 else 0.0


def by_sensitivity(rows, number):
    """The features from the least to the most sensitive one, and the rank correlation of sensitivity
    and the order in the thesis, which is that of the rows."""
    losses = [number(r) for r in rows]
    order = sorted(zip(losses, [r["feature"] for r in rows]))
    return (", ".join(f"{name} {loss:.3f}" for loss, name in order),
            rank_correlation(range(len(rows)), losses))


LEAST_CORRELATION = 0.5


@relation("points", "f.1", "points: the later the thesis presents a feature, the larger is the share of its "
          "repeatability that noise of 30 mm destroys: rank correlation of 0.5 or more",
          "Sec. 3.6: the more sophisticated a feature, the more sensitive to noise",
          "curvatures and their types, which are second derivatives, lose most; shape contexts, which come later, "
          "are sums over all neighbors")
def points_by_sophistication(tables):
    order, correlation = by_sensitivity(tables["by noise"], lambda r: 1 - r["30 mm"] / r["0 mm"])
    return f"{correlation:.2f}; {order}", correlation >= LEAST_CORRELATION


@relation("segments", "f.2", "segments: the later the thesis presents a feature, the more noise of 30 mm adds to "
          "the ratio of its distances: rank correlation of 0.5 or more",
          "Sec. 3.6: the more sophisticated a feature, the more sensitive to noise",
          "the correlation is positive, but boxes and hulls, which come late, are hardly more sensitive than the "
          "deviations; numbers of corners and mean surface variations are most sensitive")
def segments_by_sophistication(tables):
    order, correlation = by_sensitivity(tables["ratios of distances"],
                                        lambda r: r["30 mm"] - r["0 mm"])
    return f"{correlation:.2f}; {order}", correlation >= LEAST_CORRELATION


@relation("points", "f.3", "noise of 30 mm makes every feature of points less repeatable",
          "features are sensitive to noise")
def noise_matters(tables):
    kept = [r["feature"] for r in tables["by noise"] if r["30 mm"] >= r["0 mm"]]
    return ", ".join(kept) or "all are less repeatable", not kept


def ratio(tables, parts, feature):
    return next(r["ratio"] for r in tables["distances"]
                if (r["parts"], r["feature"]) == (parts, feature))


ZERNIKE = "Sec. 3.5.4: not usable, as similar segments have dissimilar vectors"


def zernike(tables, parts):
    measured = ratio(tables, parts, "Zernike")
    return f"{measured:.2f}", measured >= 0.8


@relation("zernike", "f.4", "Zernike descriptors: the distance of the same part is 0.8 or more of that of "
          "different parts, all parts", ZERNIKE,
          "nearly half of the parts are legs and other thin ones, whose vectors differ from those of extended parts")
def zernike_of_all(tables):
    return zernike(tables, "all")


@relation("zernike", "f.5", "so it is for extended parts", ZERNIKE,
          "a part of the difference between parts remains, though much less than of the basic features")
def zernike_of_extended(tables):
    return zernike(tables, "extended")


@relation("zernike", "f.6", "the five basic features: it is 0.5 at most, all parts and extended ones",
          "Sec. 5.2.2 recognizes parts by them")
def basic_features(tables):
    measured = [ratio(tables, parts, "five basic features") for parts in ("all", "extended")]
    return ", ".join(f"{m:.2f}" for m in measured), max(measured) <= 0.5


@relation("zernike", "f.7", "the ratio of Zernike descriptors, in any form, is twice that of the basic features or "
          "more, all parts and extended ones", "Sec. 3.5.4: not usable, unlike the basic features")
def zernike_is_worse(tables):
    factors = [r["ratio"] / ratio(tables, r["parts"], "five basic features")
               for r in tables["distances"] if r["feature"] != "five basic features"]
    return f"{min(factors):.1f} to {max(factors):.1f} times", min(factors) >= 2.0


def rectangles(tables, scans):
    row = next(r for r in tables["rectangles"] if (r["scans"], r["surfaces"]) == (scans, "all"))
    share = row["right edges and axes [%]"]
    return f"{share} % of {row['number']}", share >= 90.0


@relation("rectangles", "f.8", "surfaces of rooms: edges within 2 cm and one spacing, axes within 2 degrees, for 90 %",
          "not in the thesis")
def rectangles_of_rooms(tables):
    return rectangles(tables, "rooms")


@relation("rectangles", "f.9", "so it is for furniture 2 m away", "not in the thesis")
def rectangles_of_furniture(tables):
    return rectangles(tables, "furniture")


def rooms(tables, lengths, column):
    return [(r["noise [mm]"], r["number"], r[column]) for r in tables["lengths of rooms"]
            if r["lengths"] == lengths]


@relation("rooms", "f.10", "lengths of rooms: 98 % are within three stated standard deviations of the truth, with "
          "noise of 5 and of 15 mm", "not in the thesis",
          "edges of openings are misjudged where furniture hides a part of them")
def lengths_have_their_deviations(tables):
    shares = rooms(tables, "all", "within 3 standard deviations [%]")
    return ("; ".join(f"{share} % of {number} with {noise:g} mm" for noise, number, share in shares),
            min(share for _, _, share in shares) >= 98.0)


@relation("rooms", "f.11", "distances of opposite walls, and of floor and ceiling: the median error is 3 mm at most",
          "not in the thesis")
def distances_of_planes(tables):
    errors = rooms(tables, "plane to plane", "median error [mm]")
    return ("; ".join(f"{error} mm of {number} with {noise:g} mm" for noise, number, error in errors),
            max(error for _, _, error in errors) <= 3.0)


@relation("descriptors", "f.12", "spin images and shape contexts: at least 5 times as fast as PCL's, on one thread",
          "not in the thesis")
def faster_than_pcl(tables):
    rows = tables["compared with PCL"]
    measured = {d: [r["ratio"] for r in rows if r["descriptor"] == d] for d in ("spin image", "shape context")}
    text = ", ".join(f"{d}s {min(ratios)} to {max(ratios)} times" for d, ratios in measured.items())
    return text, min(r["ratio"] for r in rows) >= 5.0


@relation("growth", "f.13", "shapes of one segment: 1,000,000 points take at most 12 times the time of 100,000",
          "not in the thesis")
def linear_growth(tables):
    ratios = [r["ratio"] for r in tables["growth"]]
    return f"{min(ratios)} to {max(ratios)} times", max(ratios) <= 12.0
