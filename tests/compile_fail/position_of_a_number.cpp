// SPDX-License-Identifier: BSL-1.0
// expect: (constraints not satisfied|no matching function)[\s\S]*\bpoint\b
// A number is not a point; the message must name the concept.
#include <gnomon/core/point.hpp>

int main() { return gnomon::position(42).norm() > 0; }
