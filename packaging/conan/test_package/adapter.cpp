// SPDX-License-Identifier: BSL-1.0
// With the option json: the adapter compiles, which shows that what it adapts is found.
#include <gnomon/adapters/json_model.hpp>
