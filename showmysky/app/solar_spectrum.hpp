#pragma once
// Other suns for a model: factors on its solar spectrum.

#include <string>
#include <string_view>
#include <vector>

namespace showmysky::app {

struct SolarSpectrum {
    enum class Kind {
        model,     ///< as the model was computed
        flat,      ///< equal energy at all wavelengths
        blackBody, ///< of `temperature`
        factors    ///< on the model's, one per wavelength
    };
    Kind kind = Kind::model;
    double temperature = 5772; ///< K; nominal effective temperature of the Sun (IAU 2015 resolution B3)
    std::vector<double> factors{};

    bool operator==(const SolarSpectrum&) const = default;
};

/// `model`, `flat`, `black-body:TEMPERATURE` or factors separated by commas.   throws sky::UsageError
SolarSpectrum parseSolarSpectrum(std::string_view text);
std::string toText(const SolarSpectrum& spectrum);

/// Factors that turn a model's solar spectrum into another one of the same irradiance within the model's wavelengths.
///   wavelengthsNm    strictly increasing, at least one
///   solarIrradiance  W m^-2 nm^-1, of the model
///   returns          one factor per wavelength; empty for the model's own spectrum
///   throws           sky::UsageError where the number of given factors isn't that of the wavelengths
///   source           Planck's law; trapezoidal rule
std::vector<double> solarFactors(const SolarSpectrum& spectrum, const std::vector<double>& wavelengthsNm,
                                 const std::vector<double>& solarIrradiance);

} // namespace showmysky::app
