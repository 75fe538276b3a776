// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include <gnomon/core/detail/made_when_asked.hpp>
#include <gnomon/core/execution.hpp>

namespace {

using gnomon::detail::made_when_asked;

/// Counts how often it is made.
struct counter {
    int made = 0;
    const int* memory = nullptr;

    int of(const made_when_asked& holder, bool is_current = true) {
        return holder.get<int>([&](const int&) { return is_current; },
                               [&](int& what) {
                                   memory = &what;
                                   what = ++made;
                               });
    }
};

TEST(made_when_asked, makes_once_until_it_is_not_current) {
    made_when_asked holder;
    counter count;
    EXPECT_EQ(count.of(holder), 1);
    const int* const first = count.memory;
    EXPECT_EQ(count.of(holder), 1);
    EXPECT_EQ(count.of(holder, false), 2);
    EXPECT_EQ(count.of(holder), 2);
    holder.forget();
    EXPECT_EQ(count.of(holder), 3);
    EXPECT_EQ(count.memory, first) << "in the same memory";
}

TEST(made_when_asked, goes_with_a_move_but_not_with_a_copy) {
    made_when_asked holder;
    counter count;
    EXPECT_EQ(count.of(holder), 1);
    made_when_asked copy(holder);
    EXPECT_EQ(count.of(copy), 2);
    copy = holder;
    EXPECT_EQ(count.of(copy), 3);
    made_when_asked moved(std::move(holder));
    EXPECT_EQ(count.of(moved), 1);
    EXPECT_EQ(count.of(holder), 4);  // NOLINT: it holds nothing
    holder = std::move(moved);
    EXPECT_EQ(count.of(holder), 1);
}

TEST(made_when_asked, makes_again_what_could_not_be_made) {
    const made_when_asked holder;
    const auto current = [](const int&) { return true; };
    EXPECT_THROW((void)holder.get<int>(current, [](int&) { throw std::runtime_error("no"); }),
                 std::runtime_error);
    EXPECT_EQ(holder.get<int>(current, [](int& what) { what = 7; }), 7);
}

TEST(made_when_asked, is_made_by_one_of_many_threads) {
    const made_when_asked holder;
    int made = 0;  // guarded by the holder
    gnomon::threads{4}(64, [&](std::size_t) {
        EXPECT_EQ(
            holder.get<int>([](const int&) { return true; }, [&](int& what) { what = ++made; }), 1);
    });
}

}  // namespace
