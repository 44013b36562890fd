#pragma once
// Where `showmysky probe` takes its numbers from.

#include "showmysky/photometry.hpp"
#include <memory>
#include <string>
#include <vector>

namespace showmysky::app {

/// Answers queries one after the other.
class ProbeSource
{
public:
    virtual ~ProbeSource() = default;
    /// Names of what `answer` gives: "L_391.333nm", ... or "X", "Y", "Z", "scotopic".
    virtual std::vector<std::string> columns() const = 0;
    /// [columns]
    ///   moon  of an eclipse, or null
    virtual void answer(const Photometer::View& view, const Moon* moon, unsigned layers, double* values) = 0;
};

/// The moments: fast, or by the double-precision twin.
std::unique_ptr<ProbeSource> makeMomentSource(const std::string& directory, Photometer::Method method);
/// The baked 4D tables, with the ground (if asked for) from the moments. Spectra where all tables have them, else luminance.
///   eclipseTable  eclipses are answered too: higher orders by the model's table where it holds, the rest from the moments
///   throws        sky::Error: a table is missing
std::unique_ptr<ProbeSource> makeTextureSource(const std::string& directory, bool eclipseTable);

} // namespace showmysky::app
