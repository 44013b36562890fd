#pragma once
// A spectrum as a file tabulates it, and how it is brought to other wavelengths.

#include "atmo/source.hpp"

#include <vector>

namespace sky::atmo {

/// Points in ascending order of wavelength, nm; linear between them.
class TabulatedSpectrum
{
public:
    /// Reads a table of two columns, wavelength in nm and value; `#` begins a comment, empty lines don't count.
    ///   throws  AtmoError at the line that isn't a point, or whose wavelength is out of order
    explicit TabulatedSpectrum(const Source& table);

    double firstNm() const { return wavelengthsNm_.front(); }
    double lastNm() const { return wavelengthsNm_.back(); }
    bool covers(double nm) const { return nm >= firstNm() && nm <= lastNm(); }

    /// Linear interpolation; the end values beyond the ends.
    double at(double nm) const;
    /// Mean over `nm` +- `halfWidthNm`, as much of it as the table covers; `nm` must be covered. Exact for the
    /// piecewise-linear reading, so that a table coarser than the band is interpolated.
    double bandMean(double nm, double halfWidthNm) const;

private:
    std::vector<double> wavelengthsNm_, values_;
};

} // namespace sky::atmo
