# SPDX-License-Identifier: BSL-1.0
"""The figures of chapter 3 in the arrangement of the thesis, drawn from the cells."""

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)

from relations import ENOUGH, SCANS  # noqa: E402
from results import FIVE, SEVEN, TITLES  # noqa: E402

STYLES = dict(zip(SEVEN, [("tab:red", "o"), ("tab:blue", "s"), ("tab:green", "^"),
                          ("tab:purple", "D"), ("tab:orange", "v"), ("tab:brown", "P"),
                          ("tab:gray", "X")]))
STYLES.update({"ray_ls": ("black", "*"), "weighted_pca": ("tab:cyan", "<"),
               "robust_pca": ("tab:olive", ">")})

plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "axes.axisbelow": True,
                     "legend.frameon": False, "figure.titlesize": 11})


def save(figure, path):
    figure.savefig(path, dpi=110, bbox_inches="tight", metadata={"Software": None})
    plt.close(figure)


def legend_below(figure, handles, names, columns):
    figure.legend(handles, names, ncols=columns, loc="upper center", bbox_to_anchor=(0.5, 0))


def line(axes, method, xs, cells, counter):
    """A method's counter, with the extremes over seeds where there are some."""
    color, marker = STYLES[method]
    ys = [c[counter] for c in cells]
    axes.plot(xs, ys, color=color, marker=marker, markersize=4, linewidth=1.3, label=TITLES[method])
    spreads = [c.seeds(counter) for c in cells]
    if all(len(s) > 1 for s in spreads):
        axes.fill_between(xs, [min(s) for s in spreads], [max(s) for s in spreads], color=color,
                          alpha=0.2, linewidth=0)


def over_k(results, figure, axes, counter, **at):
    for m in SEVEN:
        cells = sorted(results.all(figure, method=m, graph="knn", **at), key=lambda c: c.at["k"])
        line(axes, m, [c.at["k"] for c in cells], cells, counter)
    axes.set_xlabel("number of neighbors k")


def fig_3_5(results, path):
    figure, axes = plt.subplots(2, 2, figsize=(11, 8.2), layout="constrained")
    at = dict(sigma_mm=15, scale=1)
    (a, b), (c, d) = axes
    over_k(results, "fig_3_5", a, "gamma", **at)
    a.set(title="(a) quality on nearest neighbors, 15 mm", ylabel="gamma (1 is perfect)")
    over_k(results, "fig_3_5", b, "us", **at)
    b.set(title="(b) time without the search (log scale)", ylabel="us per normal", yscale="log")
    over_k(results, "fig_3_5", c, "pi_01us", **at)
    c.set(title="(c) index: half quality, half speed; bound 0.1 us", ylabel="pi(0.1 us)")
    for m in FIVE:
        cells = sorted(results.all("fig_3_5", method=m, graph="delaunay", scale=1),
                       key=lambda x: x.at["sigma_mm"])
        line(d, m, [x.at["sigma_mm"] for x in cells], cells, "gamma")
    d.set(title="(d) quality on Delaunay stars", xlabel="noise sigma [mm]", ylabel="gamma")
    handles, names = a.get_legend_handles_labels()
    legend_below(figure, handles, names, 7)
    figure.suptitle("Scenario I: box and cylinder, 14,200 points (bands: extremes over seeds)")
    save(figure, path)


def fig_3_6(results, path):
    clouds = [("surrogate, 1 mm", dict(cloud="surrogate", sigma_mm=1)),
              ("surrogate, 2 mm", dict(cloud="surrogate", sigma_mm=2))]
    if results.all("fig_3_6", cloud="real"):
        clouds.append(("a real table", dict(cloud="real")))
    figure, axes = plt.subplots(3, len(clouds), figsize=(4.2 * len(clouds), 10),
                                layout="constrained", sharey="row")
    for column, (title, at) in zip(axes.T, clouds):
        for axis, counter in zip(column, ("gamma", "gamma", "pi_01us")):
            over_k(results, "fig_3_6", axis, counter, **at)
        column[0].set(title=title, ylim=(0.5, 1.01))
        column[1].set(ylim=(0.978, 1.0005))
    axes[0][0].set_ylabel("(a) gamma (1 is perfect)")
    axes[1][0].set_ylabel("(a) the best of them, enlarged")
    axes[2][0].set_ylabel("(b) index pi(0.1 us)")
    handles, names = axes[0][0].get_legend_handles_labels()
    legend_below(figure, handles, names, 7)
    figure.suptitle("Scenario II: little noise, nearest neighbors")
    save(figure, path)


def fig_3_9(results, path):
    methods = [("plane_pca", "tab:blue"), ("literal_plane_ekf", "tab:red"),
               ("plane_ekf", "tab:green")]
    many = results.values("fig_3_9", "plates")[-1]
    figure, (a, b) = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained",
                                  gridspec_kw={"width_ratios": [3, 2]})
    for i, (m, color) in enumerate(methods):
        values = results.one("fig_3_9", plates=10, method=m).seeds("gamma")
        a.bar([n + 1 + 0.27 * (i - 1) for n in range(len(values))], values, 0.25, color=color,
              label=TITLES[m])
    a.set(title="ten plates, as in the thesis (c)", xlabel="plate", ylabel="gamma (1 is perfect)",
          xticks=range(1, 11))
    legend_below(figure, *a.get_legend_handles_labels(), 3)
    cells = [results.one("fig_3_9", plates=many, method=m) for m, _ in methods]
    bars = b.bar([TITLES[m] for m, _ in methods], [c["failures_percent"] for c in cells],
                 color=[color for _, color in methods])
    b.bar_label(bars, [f"{c['failures_percent']:.2f} %" for c in cells])
    b.set(title=f"{many:,} plates: estimates with gamma below 0.99", ylabel="percent")
    b.margins(y=0.12)
    figure.suptitle("Normals of plates of 30 x 30 cm, 5 mm of noise")
    save(figure, path)


def fig_3_10(results, path):
    densities = results.values("fig_3_10", "density")
    noise = results.values("fig_3_10", "sigma_mm", scale=1)
    colors = plt.get_cmap("viridis")
    figure, axes = plt.subplots(len(densities), 3, figsize=(12, 3.3 * len(densities)),
                                layout="constrained", sharex=True, sharey=True)
    for row, density in zip(axes, densities):
        for axis, scan in zip(row, SCANS):
            for sigma_mm in noise:
                cells = sorted(results.all("fig_3_10", scan=scan, density=density,
                                           sigma_mm=sigma_mm, scale=1), key=lambda c: c.at["k"])
                color = colors(0.92 * sigma_mm / max(noise))
                axis.plot([c.at["k"] for c in cells], [c["gamma"] for c in cells], color=color,
                          linewidth=1.2, label=f"{sigma_mm} mm")
                best = max(cells, key=lambda c: c["gamma"])
                axis.plot(best.at["k"], best["gamma"], "o", color=color, markersize=6)
            if density == densities[0]:
                axis.set_title(f"({'abc'[SCANS.index(scan)]}) {scan} scan")
        row[0].set_ylabel(f"gamma, {density:,} points")
    for axis in axes[-1]:
        axis.set_xlabel("number of neighbors k")
    axes[0][0].set_ylim(0.80, 1.0)
    handles, names = axes[0][0].get_legend_handles_labels()
    legend_below(figure, handles, names, len(noise))
    figure.suptitle("PlanePCA in the kitchen: quality over k by noise; dots: the best k")
    save(figure, path)


def fig_3_11(results, path):
    cells = [c for c in results.all("fig_3_11") if c["flagged_percent"] >= ENOUGH]
    figure, (a, b) = plt.subplots(1, 2, figsize=(12, 4.8), layout="constrained", sharey=True)
    names = [f"{c['points']:,.0f} points, {c.at['sigma_mm']} mm, k = {c.at['k']}" for c in cells]
    places = range(len(cells))
    for shift, counter, color, label in (
            (-0.2, "gamma_before", "tab:red", "from k neighbors"),
            (0.2, "gamma_after", "tab:blue", "repaired, from 2 k neighbors")):
        bars = a.barh([p + shift for p in places], [c[counter] for c in cells], 0.38, color=color,
                      label=label)
        a.bar_label(bars, [f"{c[counter]:.3f}" for c in cells], padding=3, fontsize=8)
    a.set(title="gamma of the anisotropic points (1 is perfect)", yticks=places,
          yticklabels=names, xlim=(0, 1.15))
    legend_below(figure, *a.get_legend_handles_labels(), 2)
    a.invert_yaxis()
    bars = b.barh(places, [c["flagged_percent"] for c in cells], 0.5, color="tab:gray")
    b.bar_label(bars, [f"{c['flagged_percent']:.2f} %" for c in cells], padding=3)
    b.set(title="how many there are [% of all points]")
    b.margins(x=0.15)
    figure.suptitle("Vertical scans of the kitchen: normals of neighbors that are all of one scan "
                    "line\n(settings where they are at least 0.1 % of the points)")
    save(figure, path)


TYPES = [("flat", "#cccccc"), ("peak", "#b2182b"), ("ridge", "#ef8a62"),
         ("saddle_ridge", "#fddbc7"), ("minimal", "#ffffbf"), ("saddle_valley", "#d1e5f0"),
         ("valley", "#67a9cf"), ("pit", "#2166ac"), ("unknown", "#000000")]


def fig_3_14(results, path):
    figure, axes = plt.subplots(1, 2, figsize=(12, 4.6), layout="constrained", sharey=True)
    for axis, (fit, title) in zip(axes, [("thesis", "the thesis's fit"),
                                         ("shape operator", "by the shape operator")]):
        cells = results.all("fig_3_14", fit=fit)
        names = [f"{c.at['sigma_mm']} mm, k = {c.at['k']}"
                 + (", radii over 1 km flat" if c.at["tolerance"] == "rounding" else "")
                 for c in cells]
        left = [0.0] * len(cells)
        for name, color in TYPES:
            shares = [c[f"share_{name}"] for c in cells]
            if max(shares) < 0.5:
                continue
            axis.barh(names, shares, 0.7, left, color=color, edgecolor="gray", linewidth=0.4,
                      label=name.replace("_", " "))
            left = [x + s for x, s in zip(left, shares)]
        axis.set(title=title, xlabel="percent of the points within planes", xlim=(0, 100))
    axes[0].invert_yaxis()
    known = {name: handle for axis in axes for handle, name in
             zip(*axis.get_legend_handles_labels())}
    legend_below(figure, known.values(), known.keys(), 9)
    figure.suptitle("Surface types in the kitchen, where everything is flat")
    save(figure, path)


def decision(results, path):
    noise = results.values("decision", "sigma_mm")
    figure, axes = plt.subplots((len(noise) + 1) // 2, 2, figsize=(11, 4.2 * ((len(noise) + 1) // 2)),
                                layout="constrained", squeeze=False)
    axes = axes.flat
    for axis, sigma_mm in zip(axes, noise):
        cells = results.all("decision", sigma_mm=sigma_mm)
        best = max(c["gamma"] for c in cells)
        for m in dict.fromkeys(c.at["method"] for c in cells):
            color, marker = STYLES[m]
            for graph, filled in (("knn", True), ("angularly_sorted_knn", False), ("delaunay", False)):
                some = sorted((c for c in cells if c.at["method"] == m
                               and c.at["graph"] == graph), key=lambda c: c.at.get("k", 0))
                if not some:
                    continue
                axis.plot([c["us_with_search"] for c in some], [c["gamma"] for c in some],
                          marker=marker, markersize=6, color=color, linewidth=0.8,
                          markerfacecolor=color if filled else "white",
                          label=TITLES[m] if graph == "knn" else None)
        axis.set(title=f"noise of {sigma_mm} mm", xscale="log", ylabel="gamma (cut below)",
                 xlabel="us per normal with the search", ylim=(best - 0.12, best + 0.008))
        axis.set_xticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
        axis.minorticks_off()
    handles, names = axes[0].get_legend_handles_labels()
    legend_below(figure, handles, names, 5)
    figure.suptitle("Quality and time in the kitchen, 28,800 points: upper left is better.\n"
                    "Lines: k = 10, 20, 30, 50 nearest neighbors; open symbols in a line: in angular "
                    "order, k = 10, 30; alone: Delaunay stars")
    save(figure, path)


PICTURES = {"fig_3_5": fig_3_5, "fig_3_6": fig_3_6, "fig_3_9": fig_3_9, "fig_3_10": fig_3_10,
            "fig_3_11": fig_3_11, "fig_3_14": fig_3_14, "decision": decision}
