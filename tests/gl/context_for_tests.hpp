#pragma once
// A context for tests that need one. Catch2 v2 can't mark a test as skipped, so it prints the reason and returns:
//     const auto context = gl::testing::context();
//     if (!context)
//         return;

#include <optional>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "gl/context.hpp"

namespace sky::gl::testing {

inline std::optional<HeadlessContext> context(const HeadlessOptions& options = {})
{
    try {
        return HeadlessContext(options);
    } catch (const GlError& error) {
        WARN("SKIPPED: " << error.what());
        return std::nullopt;
    }
}

} // namespace sky::gl::testing
