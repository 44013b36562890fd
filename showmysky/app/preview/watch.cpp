#include "watch.hpp"

namespace showmysky::app::preview {

Watch::Look Watch::look() const
{
    std::error_code error;
    Look result;
    result.time = std::filesystem::last_write_time(path_, error);
    if (!error)
        result.size = std::filesystem::file_size(path_, error);
    return error ? Look{} : Look{true, result.time, result.size};
}

bool Watch::changed()
{
    const Look now = look();
    const bool steady = now == seen_;
    seen_ = now;
    if (!steady || !now.there || now == settled_)
        return false;
    settled_ = now;
    return true;
}

} // namespace showmysky::app::preview
