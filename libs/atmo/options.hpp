#pragma once
// How spectra in files are brought to the wavelengths of a description.

namespace sky::atmo {

enum class Resampling {
    BandAverage, ///< mean of the piecewise-linear file over half a grid step to either side, clipped to the file's
                 ///< range
    Point        ///< piecewise-linear interpolation at the wavelength itself
};

/// What a wavelength outside of a file's range means.
enum class OutsideRange { Error, Zero, EndValue };

/// Defaults for all spectra in files; `[resample=...]` and `[outside=...]` in the description win.
struct ParseOptions {
    Resampling resampling = Resampling::BandAverage;
    OutsideRange outside = OutsideRange::Error;
};

} // namespace sky::atmo
