#pragma once

#include "showmysky/export.h"
#include <stdexcept>
#include <string>

namespace showmysky {

/// Why something failed, for programs; what() is the sentence for people.
enum class ErrorKind {
    model,       ///< the model directory is missing, damaged or not a model
    settings,    ///< an argument is outside its range
    unsupported, ///< the model or this version can't do what the settings ask for
    openGl,      ///< the host's context is too old, lost, or its driver refused
    cancelled,   ///< the host asked to stop
    other
};

/// The only exception that leaves the library.
class SHOWMYSKY_API Error : public std::runtime_error
{
public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
};

} // namespace showmysky
