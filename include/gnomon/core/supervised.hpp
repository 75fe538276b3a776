// SPDX-License-Identifier: BSL-1.0
/// @file
/// Stopping a long computation, and following its progress. Both belong to the execution, so that
/// every algorithm has them:
///
///     gnomon::stop_source stop;                     // another thread calls stop.request_stop()
///     auto run = gnomon::supervised(gnomon::team(4), stop.token(), on_step);
///     try { auto seen = chain(scan, run); } catch (const gnomon::stopped&) { ... }
#pragma once

#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <memory>
#include <type_traits>
#include <utility>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>

namespace gnomon {

/// What an algorithm throws whose stop was requested.
class stopped : public std::exception {
  public:
    /// The message.
    [[nodiscard]] const char* what() const noexcept override { return "stopped on request"; }
};

/// Asks whether a stop was requested. Copies are cheap and ask the same source; a token that no
/// source gave is never asked to stop. Thread-safe.
class stop_token {
  public:
    stop_token() = default;

    /// Whether a stop was requested. Thread-safe.
    [[nodiscard]] bool stop_requested() const {
        return requested_ && requested_->load(std::memory_order_relaxed);
    }

  private:
    friend class stop_source;
    explicit stop_token(std::shared_ptr<const std::atomic<bool>> requested)
        : requested_(std::move(requested)) {}

    std::shared_ptr<const std::atomic<bool>> requested_;
};

/// Requests a stop from all algorithms that were given its token. Thread-safe.
class stop_source {
  public:
    stop_source() : requested_(std::make_shared<std::atomic<bool>>(false)) {}

    void request_stop() { requested_->store(true, std::memory_order_relaxed); }  ///< thread-safe
    /// Lets the tokens be used for the next call.
    void reset() { requested_->store(false, std::memory_order_relaxed); }
    /// For a `supervised` execution.
    [[nodiscard]] stop_token token() const { return stop_token(requested_); }

  private:
    std::shared_ptr<std::atomic<bool>> requested_;
};

namespace detail {

struct no_progress {
    void operator()(const char*, std::size_t, std::size_t) const {}
};

/// Announces a step to executions that have begin_step().
template <execution X>
void begin_step(const X& run, const char* name, std::size_t step, std::size_t steps) {
    if constexpr (requires { run.begin_step(name, step, steps); })
        run.begin_step(name, step, steps);
}

}  // namespace detail

/// An execution that throws `stopped` before the next chunk of work once a stop is requested, and
/// calls on_step(name, step, steps) on the calling thread at the beginning of each step of an
/// algorithm that has named ones, such as `perception`.
template <execution X, class OnStep = detail::no_progress>
class supervised {
  public:
    /// @param run  the execution that does the work
    explicit supervised(X run, stop_token stop = {}, OnStep on_step = {})
        : run_(std::move(run)), stop_(std::move(stop)), on_step_(std::move(on_step)) {}

    /// The same contract as that of the underlying execution.
    /// @throws stopped  once a stop is requested; what the algorithm was to return is lost
    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        run_(chunks, [&](std::size_t c) {
            if (stop_.stop_requested()) GNOMON_THROW(stopped());
            work(c);
        });
    }

    /// Announces that step number `step` of `steps` begins.
    /// @throws stopped  if a stop is requested
    void begin_step(const char* name, std::size_t step, std::size_t steps) const {
        if (stop_.stop_requested()) GNOMON_THROW(stopped());
        on_step_(name, step, steps);
        detail::begin_step(run_, name, step, steps);
    }

    /// The same supervision of an execution whose threads stay from one step to the next.
    [[nodiscard]] decltype(auto) staying() const {
        using staying_run = decltype(detail::staying(run_));
        if constexpr (std::is_reference_v<staying_run>)
            return (*this);
        else
            return supervised<staying_run, OnStep>(detail::staying(run_), stop_, on_step_);
    }

  private:
    X run_;
    stop_token stop_;
    OnStep on_step_;
};

}  // namespace gnomon
