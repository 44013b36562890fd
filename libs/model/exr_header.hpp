#pragma once
#include "model/table.hpp"
#include <cstdint>
#include <istream>
#include <string>

namespace sky::model {

/// Checks that an EXR file is the plain scanline image that the manifest says, before the OpenEXR library sees it: the
/// library allocates what a header asks for, so a few hostile bytes could ask for gigabytes.
///   fileBytes  length of the stream
///   place      named in messages
///   throws     ModelError
void checkExrHeader(std::istream& stream, std::uint64_t fileBytes, const Table& table, const std::string& place);

} // namespace sky::model
