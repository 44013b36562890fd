#pragma once
// What must hold for any text taken as a description or as a spectrum's table. The fuzzer and an ordinary test share it.

#include "atmo/parse.hpp"
#include "atmo/tabulated_spectrum.hpp"
#include "atmo/write.hpp"
#include "base/error.hpp"

#include <stdexcept>
#include <string_view>

namespace fuzz {

inline void requireThat(bool condition, const char* what)
{
    if (!condition)
        throw std::logic_error(what);
}

/// A text is refused with an AtmoError, or its canonical text means the same. Anything else gets out.
inline void checkDescription(std::string_view text)
{
    using namespace sky::atmo;
    try {
        // A folder that can't exist, so that relative paths lead nowhere.
        const Description description = parse(text, "fuzz.atmo", "no such folder\n");
        const std::string canonical = write(description);
        requireThat(parse(canonical, "canonical.atmo", {}) == description, "the canonical text means something else");
    } catch (const sky::AtmoError& error) {
        requireThat(std::string_view(error.what()).find(": ") != std::string_view::npos, "an error without place");
    }
}

/// A table is refused with an AtmoError, or its wavelengths rise and each point in its range has a band around it.
inline void checkTable(std::string_view text)
{
    using namespace sky::atmo;
    try {
        const TabulatedSpectrum table(Source(text, "fuzz.csv"));
        requireThat(table.firstNm() <= table.lastNm(), "the table is not sorted");
        for (const double nm : {table.firstNm(), 550.0, table.lastNm()})
            if (table.covers(nm))
                requireThat(table.bandMean(nm, 0) == table.at(nm), "a band without width is not its point");
        if (table.covers(550))
            table.bandMean(550, 10);
    } catch (const sky::AtmoError& error) {
        requireThat(error.location().line >= 1, "an error without place");
    }
}

} // namespace fuzz
