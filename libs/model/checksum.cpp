#include "model/checksum.hpp"
#include "base/error.hpp"

#include <cstdio>
#include <fstream>
#include <memory>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace sky::model {

FileInfo fileInfo(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
    XXH3_128bits_reset(state.get());
    std::vector<char> buffer(1 << 20);
    FileInfo info;
    while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())), file.gcount() > 0) {
        XXH3_128bits_update(state.get(), buffer.data(), static_cast<std::size_t>(file.gcount()));
        info.bytes += static_cast<std::uint64_t>(file.gcount());
    }
    if (!file.eof())
        throw FileError("Can't read '" + path.string() + "'.");
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    char text[33];
    std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                  static_cast<unsigned long long>(hash.low64));
    info.xxh3 = text;
    return info;
}

} // namespace sky::model
