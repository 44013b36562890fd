#pragma once
// Spectra as entries: lists, files and sums of weighted files.

#include "atmo/document.hpp"
#include "atmo/options.hpp"

#include <filesystem>
#include <limits>

namespace sky::atmo {

/// What all spectra of a description share.
struct SpectrumContext {
    const Source& source;
    const Wavelengths& wavelengths;
    const std::filesystem::path& directory; ///< paths in the description begin here
    const ParseOptions& options;
};

/// Legal values of a spectrum.
struct SpectrumRange {
    double max = std::numeric_limits<double>::infinity(); ///< the least is always 0
};

/// The spectrum of one key: a list or a file in one entry, or weighted files in any number of them.
///   throws  AtmoError for a wrong form, a file that can't be read, a wavelength that a file doesn't cover (unless it
///           is to be extended), or a value outside of `range`
Spectrum readSpectrum(const SpectrumContext& context, const std::vector<const Entry*>& entries, SpectrumRange range);

} // namespace sky::atmo
