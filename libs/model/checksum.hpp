#pragma once
#include "model/manifest.hpp"
#include <filesystem>

namespace sky::model {

/// Size and checksum of a file.   throws FileError
FileInfo fileInfo(const std::filesystem::path& path);

} // namespace sky::model
