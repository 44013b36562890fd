#include "atmo/fields.hpp"

#include "atmo/keys.hpp"
#include "atmo/value.hpp"

#include <algorithm>

namespace sky::atmo {

namespace {

bool contains(std::span<const std::string_view> keys, std::string_view wanted)
{
    const std::string compared = comparable(wanted);
    return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return comparable(key) == compared; });
}

[[noreturn]] void failUnknown(const Source& source, const Entry& entry, const std::string& where, std::span<const std::string_view> known,
                              std::span<const std::string_view> other)
{
    std::string hint;
    if (entry.kind == Entry::Kind::Token)
        hint = "; expected `key: value`";
    if (contains(other, entry.key))
        hint = "; it belongs on another level, check the braces";
    else if (const std::string_view best = nearest(entry.key, known); !best.empty())
        hint = "; did you mean `" + std::string(best) + "`?";
    const std::string what = entry.kind == Entry::Kind::Token ? " is not an entry of " : " is not a key of ";
    source.fail(entry.keyPlace, inBackticks(entry.key) + what + where + hint);
}

} // namespace

bool isWeightedFile(const Entry& entry)
{
    const std::string_view value = entry.value;
    const std::size_t end = std::min(value.find_first_of(" \t"), value.size());
    return entry.kind == Entry::Kind::Value && comparable(value.substr(0, end)) == "weighted";
}

Fields::Fields(const Source& source, std::vector<std::reference_wrapper<const Entry>> entries, const std::string& where,
               std::span<const std::string_view> known, std::span<const std::string_view> other)
    : entries_(std::move(entries))
{
    // An unknown key stops the reading, so there are at most as many different ones as known keys.
    std::vector<const Entry*> seen;
    for (const Entry& entry : entries_) {
        if (!contains(known, entry.key))
            failUnknown(source, entry, where, known, other);
        const std::string compared = comparable(entry.key);
        const auto earlier = std::find_if(seen.begin(), seen.end(), [&](const Entry* e) { return comparable(e->key) == compared; });
        if (earlier == seen.end())
            seen.push_back(&entry);
        else if (!isWeightedFile(entry) || !isWeightedFile(**earlier))
            source.fail(entry.keyPlace, inBackticks(entry.key) + " was given before, in line " + std::to_string((*earlier)->keyPlace.line) +
                                            "; expected it once (only `weighted file` spectra add up)");
    }
}

std::vector<const Entry*> Fields::all(std::string_view key) const
{
    std::vector<const Entry*> found;
    const std::string compared = comparable(key);
    for (const Entry& entry : entries_)
        if (comparable(entry.key) == compared)
            found.push_back(&entry);
    return found;
}

const Entry* Fields::find(std::string_view key) const
{
    const std::vector<const Entry*> found = all(key);
    return found.empty() ? nullptr : found.front();
}

} // namespace sky::atmo
