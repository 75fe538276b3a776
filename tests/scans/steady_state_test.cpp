// SPDX-License-Identifier: BSL-1.0
/// @file
/// Repeated calls of perception in the memory of one result: the number and the size of their
/// allocations, and the growth of resident memory. Replaces malloc and the functions like it, which
/// operator new calls; so it is a program of its own, without sanitizers, for glibc.
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>
#include <gnomon/simulation/trajectory.hpp>
#include <malloc.h>
#include <unistd.h>

namespace {

std::atomic<bool> is_counting{false};
std::atomic<std::size_t> allocations{0}, allocated_bytes{0};

void count(std::size_t bytes) {
    if (!is_counting.load(std::memory_order_relaxed)) return;
    allocations.fetch_add(1, std::memory_order_relaxed);
    allocated_bytes.fetch_add(bytes, std::memory_order_relaxed);
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
    count(size);
    return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
    count(number * size);
    return __libc_calloc(number, size);
}
void* realloc(void* old, std::size_t size) {
    count(size);
    return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
    count(size);
    return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    count(size);
    return __libc_memalign(alignment, size);
}
int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
    count(size);
    *result = __libc_memalign(alignment, size);
    return *result == nullptr ? 12 : 0;  // ENOMEM
}

}  // extern "C"

namespace {

/// [bytes]
std::size_t resident_memory() {
    std::size_t all = 0, resident = 0;
    std::FILE* const file = std::fopen("/proc/self/statm", "r");
    EXPECT_EQ(std::fscanf(file, "%zu %zu", &all, &resident), 2);
    std::fclose(file);
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// About n points of the kitchen.
gnomon::scan scan_of(std::size_t n) {
    namespace simulation = gnomon::simulation;
    const simulation::scene kitchen = simulation::scenes::kitchen();
    simulation::scanner finder;  // 180 degrees in 40 lines a second
    finder.resolution = gnomon::degrees(0.25);
    simulation::rotational trajectory{.mount = kitchen.sensor};
    trajectory.duration =
        static_cast<double>(n) / (static_cast<double>(finder.beams()) * finder.frequency);
    return simulation::simulate(kitchen, trajectory, finder, {.sigma = 0.015, .seed = 4}).scan;
}

/// What the replaced functions count is what the program allocates.
TEST(steady_state, counts_allocations) {
    allocations = allocated_bytes = 0;
    is_counting = true;
    void* const by_malloc = std::malloc(1000);
    void* const by_aligned_alloc = std::aligned_alloc(64, 640);
    void* const by_new = ::operator new(100);
    void* const by_aligned_new = ::operator new(128, std::align_val_t{64});
    is_counting = false;
    EXPECT_EQ(allocations, 4u);
    EXPECT_EQ(allocated_bytes, 1868u);
    ::operator delete(by_aligned_new, std::align_val_t{64});
    ::operator delete(by_new);
    std::free(by_aligned_alloc);
    std::free(by_malloc);
}

constexpr std::size_t most_allocations = 500, most_bytes = 64 << 10;  // in a call

/// After the first call, further ones of the same chain allocate hardly any memory each, and
/// resident memory does not grow.
void expect_steady(std::size_t n, std::size_t calls, const auto& run) {
    constexpr std::size_t most_growth = 1 << 20;  // [bytes]
    const gnomon::scan scan = scan_of(n);
    ASSERT_NEAR(static_cast<double>(scan.size()), static_cast<double>(n),
                0.03 * static_cast<double>(n));
    const gnomon::perception<> chain;
    auto result = chain(scan, run);
    const auto labels = result.surfaces.labels();
    ASSERT_GT(result.surfaces.size(), 5u);
    const std::size_t before = resident_memory();
    for (std::size_t c = 0; c < calls; ++c) {
        allocations = allocated_bytes = 0;
        is_counting = true;
        chain.into(result, scan, run);
        is_counting = false;
        EXPECT_LE(allocations, most_allocations) << "call " << c;
        EXPECT_LE(allocated_bytes, most_bytes) << "call " << c;
    }
    const std::size_t after = resident_memory();
    EXPECT_LT(after, before + most_growth);
    EXPECT_EQ(result.surfaces.labels(), labels);
}

TEST(steady_state, of_few_points_on_one_thread) {
    expect_steady(20'000, 100, gnomon::sequential{});
}
TEST(steady_state, of_many_points_on_one_thread) {
    expect_steady(200'000, 20, gnomon::sequential{});
}
TEST(steady_state, of_few_points_on_a_team) { expect_steady(20'000, 100, gnomon::team(2)); }
TEST(steady_state, of_many_points_on_a_team) { expect_steady(200'000, 20, gnomon::team(2)); }

}  // namespace
