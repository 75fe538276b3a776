// SPDX-License-Identifier: BSL-1.0
// A point of the user's own type goes in, a position comes out.
#include <gnomon/gnomon.hpp>

namespace {
struct corner {
    float x, y, z;
};
}  // namespace

int main() { return gnomon::position(corner{3, 0, 4}).norm() == 5.0 ? 0 : 1; }
