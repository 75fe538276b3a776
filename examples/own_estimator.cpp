// SPDX-License-Identifier: BSL-1.0
// How do I try a normal estimator of my own against those of the library?
#include <cmath>
#include <cstdio>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace {

// [own_lambdas]
// A lambda that returns a vector as a value (without `-> Eigen::Vector3d`, Eigen returns an
// expression that refers to destroyed temporaries): the normal of the triangle of the first two
// neighbors.
const auto first_triangle = [](const auto& p, auto neighbors) -> Eigen::Vector3d {
    if (neighbors.size() < 2) return Eigen::Vector3d::Zero();
    return (neighbors[0] - p).cross(neighbors[1] - p);
};

// A third argument receives the view point: the normal can be turned towards it.
const auto facing_triangle = [](const auto& p, auto neighbors,
                                const Eigen::Vector3d& viewpoint) -> Eigen::Vector3d {
    const Eigen::Vector3d n = first_triangle(p, neighbors);
    return n.dot(viewpoint - p) < 0.0 ? Eigen::Vector3d(-n) : n;
};
// [own_lambdas]

// [own_estimator]
// A struct can have parameters and further results: a plane fit in which near neighbors have larger
// weights than far ones.
struct gaussian_pca {
    double width = 0.02;  // [m]

    gnomon::plane_fit operator()(const Eigen::Vector3d& p,
                                 gnomon::neighborhood_view neighbors) const {
        double weights = 1.0;  // that of the point itself
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();
        for (const Eigen::Vector3d& q : neighbors) {
            const Eigen::Vector3d d = q - p;
            const double w = std::exp(-0.5 * d.squaredNorm() / (width * width));
            weights += w;
            mean += w * d;
            outer += w * d * d.transpose();
        }
        mean /= weights;
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;  // eigenvalues ascend
        solver.computeDirect(outer / weights - mean * mean.transpose());

        gnomon::plane_fit fit;
        fit.spectrum = gnomon::spectrum(solver.eigenvalues().reverse());
        fit.trust = neighbors.size() < 2 ? gnomon::trust::too_few_neighbors : gnomon::trust::good;
        fit.normal = solver.eigenvectors().col(0);
        return fit;
    }
};
// [own_estimator]

void report(const char* name, const gnomon::simulation::true_scan& truth, const auto& estimator) {
    const auto surface =
        gnomon::estimate_normals(truth.scan, gnomon::knn{.k = 50}, estimator, gnomon::threads{});
    std::printf("%-28s gamma %.4f\n", name, gnomon::mean_gamma(surface, truth.normals));
}

}  // namespace

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Compares estimators of its own with one of the library."))
        return 0;
    const auto truth =
        gnomon::simulation::simulate(gnomon::simulation::box_and_cylinder{.sigma = 0.005});
    report("first_triangle (a lambda)", truth, first_triangle);
    report("facing_triangle (another)", truth, facing_triangle);
    report("gaussian_pca (a struct)", truth, gaussian_pca{.width = 0.02});
    report("plane_pca (the library's)", truth, gnomon::plane_pca{});
}
