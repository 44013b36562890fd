#pragma once
// From the text of a description to its typed content.

#include "atmo/description.hpp"
#include "atmo/options.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace sky::atmo {

/// Reads a description (docs/language.md).
///   fileName   what messages call the text
///   directory  relative paths of spectra begin here
///   throws     AtmoError for everything wrong in the text or in a spectrum's file
Description parse(std::string_view text, const std::string& fileName, const std::filesystem::path& directory,
                  const ParseOptions& options = {});

/// Reads the file at `path`; spectra resolve relative to its directory.
///   throws  FileError if it can't be read, AtmoError as parse()
Description parseFile(const std::filesystem::path& path, const ParseOptions& options = {});

} // namespace sky::atmo
