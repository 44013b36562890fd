#pragma once
// The canonical text of a description.

#include "atmo/description.hpp"

#include <string>

namespace sky::atmo {

/// Text that parse() reads back to exactly `description`: every key is there, in a fixed order, spectra are lists.
///   throws  RangeError if no text stands for it: a spectrum's length differs from the count of wavelengths, a code
///           block contains ``` or a carriage return or NUL
std::string write(const Description& description);

} // namespace sky::atmo
