#pragma once
// The entries of one level, found by key: unknown and doubled keys are refused on construction.

#include "atmo/document.hpp"

#include <functional>
#include <span>

namespace sky::atmo {

class Fields
{
public:
    /// \param where   what the entries belong to, for messages: "a description", "a scatterer"
    /// \param known   the keys of this level
    /// \param other   keys of the other levels, so that a key in the wrong place is called that
    ///   throws  AtmoError for a key that is unknown or comes twice (`weighted file` entries may)
    Fields(const Source& source, std::vector<std::reference_wrapper<const Entry>> entries, const std::string& where,
           std::span<const std::string_view> known, std::span<const std::string_view> other);

    /// The entries of `key` in their order; only a spectrum of weighted files has more than one.
    std::vector<const Entry*> all(std::string_view key) const;
    /// The entry of `key`, or null.
    const Entry* find(std::string_view key) const;

private:
    std::vector<std::reference_wrapper<const Entry>> entries_;
};

/// True if the value begins with the words "weighted file".
bool isWeightedFile(const Entry& entry);

} // namespace sky::atmo
