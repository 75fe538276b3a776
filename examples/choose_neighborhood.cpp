// SPDX-License-Identifier: BSL-1.0
// Which neighborhood shall I take, and which estimator goes with it?
#include <cstddef>
#include <cstdio>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace {

void report(const char* name, const gnomon::simulation::true_scan& truth, const auto& surface) {
    double neighbors = 0.0;
    std::size_t good = 0;
    for (const auto& s : surface) {
        neighbors += s.neighbors;
        good += s.trust == gnomon::trust::good;
    }
    const auto n = static_cast<double>(surface.size());
    std::printf("%-44s gamma %.4f, %4.1f neighbors, %5.1f %% good\n", name,
                gnomon::mean_gamma(surface, truth.normals), neighbors / n,
                100.0 * static_cast<double>(good) / n);
}

}  // namespace

int main(int argc, char** argv) {
    if (printed_help(
            argc, argv,
            "Compares neighborhoods, and the estimators that go with them, on a simulated scan."))
        return 0;
    const auto truth =
        gnomon::simulation::simulate(gnomon::simulation::box_and_cylinder{.sigma = 0.005});
    const auto& scan = truth.scan;
    using namespace gnomon;

    // [choose_neighborhood]
    // The usual choice, and the same for noise along the rays, with the view points of the scan.
    report("knn, plane_pca", truth, estimate_normals(scan, knn{.k = 30}, plane_pca{}));
    report("knn, ray_ls", truth, estimate_normals(scan, knn{.k = 30}, ray_ls{}));
    // No farther than 5 cm; as many as a noise of 5 mm requires; about six, in angular order.
    report("hybrid, plane_pca", truth,
           estimate_normals(scan, hybrid{.k = 30, .r = 0.05}, plane_pca{}));
    const adaptive_knn<prefer_small_error> adaptive{
        .growth = 1.3, .preference = {.noise = gnomon::constant_noise{0.005}}};
    report("adaptive_knn, plane_pca", truth, estimate_normals(scan, adaptive, plane_pca{}));
    report("delaunay, angle_weighted", truth, estimate_normals(scan, delaunay{}, angle_weighted{}));
    // Averages of triangles need an order around the point, or a common sign.
    report("knn, area_weighted", truth, estimate_normals(scan, knn{.k = 30}, area_weighted{}));
    report("angularly_sorted knn, area_weighted", truth,
           estimate_normals(scan, angularly_sorted{knn{.k = 30}}, area_weighted{}));
    report(
        "knn, area_weighted towards the view point", truth,
        estimate_normals(scan, knn{.k = 30}, area_weighted{.sign = triangle_sign::to_viewpoint}));
    // [choose_neighborhood]
}
