// SPDX-License-Identifier: BSL-1.0
// The tool chain of the thesis: neighbors by ANN, planes by GSL's singular value decomposition.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "loops.hpp"
#include "peer.hpp"
#include <ANN/ANN.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_version.h>

namespace {

struct gsl_free {
    void operator()(gsl_matrix* m) const { gsl_matrix_free(m); }
    void operator()(gsl_vector* v) const { gsl_vector_free(v); }
};
using matrix = std::unique_ptr<gsl_matrix, gsl_free>;
using vector = std::unique_ptr<gsl_vector, gsl_free>;

/// The direction of least variance of k points: the last right singular vector of their offsets
/// from the mean.
class plane_svd {
  public:
    explicit plane_svd(std::size_t k) : rows_(gsl_matrix_alloc(k, 3)) {}

    Eigen::Vector3d operator()(const ANNpoint* points, const std::vector<ANNidx>& neighbors) {
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (const ANNidx j : neighbors) mean += Eigen::Map<const Eigen::Vector3d>(points[j]);
        mean /= static_cast<double>(neighbors.size());
        for (std::size_t row = 0; row < neighbors.size(); ++row) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                gsl_matrix_set(
                    rows_.get(), row, axis,
                    points[neighbors[row]][axis] - mean[static_cast<Eigen::Index>(axis)]);
            }
        }
        gsl_linalg_SV_decomp(rows_.get(), v_.get(), s_.get(), work_.get());
        return {gsl_matrix_get(v_.get(), 0, 2), gsl_matrix_get(v_.get(), 1, 2),
                gsl_matrix_get(v_.get(), 2, 2)};
    }

  private:
    matrix rows_;
    matrix v_{gsl_matrix_alloc(3, 3)};
    vector s_{gsl_vector_alloc(3)};
    vector work_{gsl_vector_alloc(3)};
};

/// What is alike for both.
class on_points {
  public:
    static constexpr bool one_thread_only = true;  // ANN keeps the state of a search in globals

    explicit on_points(const peers::vectors& points)
        : n_(static_cast<int>(points.size())), points_(annAllocPts(n_, 3)) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            std::copy_n(points[i].data(), 3, points_[i]);
        }
    }
    on_points(const on_points&) = delete;
    on_points& operator=(const on_points&) = delete;
    ~on_points() { annDeallocPts(points_); }

  protected:
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(n_); }
    [[nodiscard]] ANNpointArray points() const { return points_; }

    /// Calls visit(i, neighbors) with the k nearest neighbors of each point, itself among them.
    void for_each_neighborhood(std::size_t k, auto&& visit) const {
        ANNkd_tree tree(points_, n_, 3);
        std::vector<ANNidx> neighbors(k + 1);  // the point itself is found, too
        std::vector<ANNdist> squares(k + 1);
        for (std::size_t i = 0; i < size(); ++i) {
            tree.annkSearch(points_[i], static_cast<int>(k) + 1, neighbors.data(), squares.data());
            visit(i, neighbors);
        }
    }

  private:
    int n_;
    ANNpointArray points_;
};

struct search : on_points, peers::search_job {
    static constexpr const char* library = "ANN";

    using on_points::on_points;
    auto operator()(const peers::request& r) const {
        peers::neighbor_lists lists(size(), r.k());
        for_each_neighborhood(
            r.k(), [&](std::size_t i, const auto& neighbors) { lists.set(i, neighbors); });
        return lists;
    }
};

struct normals : on_points {
    static constexpr const char* task = "normals";
    static constexpr const char* library = "ANN + GSL";

    using on_points::on_points;
    auto operator()(const peers::request& r) const {
        plane_svd fit(r.k() + 1);
        peers::vectors result(size());
        for_each_neighborhood(r.k(), [&](std::size_t i, const auto& neighbors) {
            result[i] = fit(points(), neighbors);
        });
        return result;
    }

    static Eigen::Vector3d normal(const peers::vectors& result, std::size_t i) { return result[i]; }
    static std::size_t bytes(const peers::vectors& result) {
        return result.size() * sizeof(result[0]);
    }
};

}  // namespace

int main(int argc, char** argv) {
    return peers::serve<search, normals>(std::string(ANNversion) + " + " + GSL_VERSION, argc, argv);
}
