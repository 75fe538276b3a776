// SPDX-License-Identifier: BSL-1.0
// The tool chain of the thesis: neighbors by ANN, planes by GSL's singular value decomposition.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

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

/// The direction in which k points vary least: the last right singular vector of what they are
/// apart from their mean.
class plane_svd {
  public:
    explicit plane_svd(std::size_t k) : rows_(gsl_matrix_alloc(k, 3)) {}

    Eigen::Vector3d operator()(const ANNpoint* points, const std::vector<ANNidx>& ring) {
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (const ANNidx j : ring) mean += Eigen::Map<const Eigen::Vector3d>(points[j]);
        mean /= static_cast<double>(ring.size());
        for (std::size_t row = 0; row < ring.size(); ++row) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                gsl_matrix_set(rows_.get(), row, axis,
                               points[ring[row]][axis] - mean[static_cast<Eigen::Index>(axis)]);
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

class normals {
  public:
    static constexpr const char* task = "normals";
    static constexpr const char* library = "ANN + GSL";
    static constexpr bool one_thread_only = true;  // ANN keeps the state of a search in globals

    explicit normals(const peers::vectors& points)
        : n_(static_cast<int>(points.size())), points_(annAllocPts(n_, 3)) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            std::copy_n(points[i].data(), 3, points_[i]);
        }
    }
    normals(const normals&) = delete;
    normals& operator=(const normals&) = delete;
    ~normals() { annDeallocPts(points_); }

    auto operator()(const peers::request& r) const {
        ANNkd_tree tree(points_, n_, 3);
        const int k = static_cast<int>(r.k) + 1;  // the point itself is found, too
        std::vector<ANNidx> ring(r.k + 1);
        std::vector<ANNdist> squares(r.k + 1);
        plane_svd fit(r.k + 1);
        peers::vectors result(static_cast<std::size_t>(n_));
        for (std::size_t i = 0; i < result.size(); ++i) {
            tree.annkSearch(points_[i], k, ring.data(), squares.data());
            result[i] = fit(points_, ring);
        }
        return result;
    }

    static Eigen::Vector3d normal(const peers::vectors& result, std::size_t i) { return result[i]; }

  private:
    int n_;
    ANNpointArray points_;
};

}  // namespace

int main(int argc, char** argv) {
    return peers::serve<normals>(std::string(ANNversion) + " + " + GSL_VERSION, argc, argv);
}
