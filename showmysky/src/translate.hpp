#pragma once
// Errors of our libraries become showmysky::Error where they leave the library.

#include "base/error.hpp"
#include "showmysky/error.hpp"
#include <new>
#include <utility>

namespace showmysky {

/// Throws the exception in flight as showmysky::Error.
[[noreturn]] void rethrowTranslated();

template<class Action>
decltype(auto) translated(Action&& action)
{
    try {
        return std::forward<Action>(action)();
    } catch (...) {
        rethrowTranslated();
    }
}

} // namespace showmysky
