#include "solar_spectrum.hpp"

#include "base/error.hpp"
#include "number_text.hpp"
#include <cmath>

namespace showmysky::app {

namespace {

constexpr std::string_view blackBodyPrefix = "black-body:";
constexpr double coolest = 500, hottest = 1e6; // K

/// Planck's law by wavelength, over its value at `referenceNm`, so that nothing overflows.
double planck(double wavelengthNm, double temperature, double referenceNm)
{
    constexpr double c2 = 1.438776877e7; // second radiation constant, nm K (CODATA 2018)
    return std::pow(referenceNm / wavelengthNm, 5) * std::expm1(c2 / (referenceNm * temperature)) /
           std::expm1(c2 / (wavelengthNm * temperature));
}

double integral(const std::vector<double>& x, const std::vector<double>& y)
{
    if (x.size() == 1)
        return y[0];
    double sum = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
        sum += (x[i + 1] - x[i]) * (y[i] + y[i + 1]) / 2;
    return sum;
}

} // namespace

SolarSpectrum parseSolarSpectrum(std::string_view text)
{
    SolarSpectrum result;
    if (text == "model")
        return result;
    if (text == "flat") {
        result.kind = SolarSpectrum::Kind::flat;
        return result;
    }
    if (text.substr(0, blackBodyPrefix.size()) == blackBodyPrefix) {
        result.kind = SolarSpectrum::Kind::blackBody;
        const auto temperature = parseNumber(text.substr(blackBodyPrefix.size()));
        if (!temperature || !(*temperature >= coolest && *temperature <= hottest))
            throw sky::UsageError("`" + std::string(text) + "` has no temperature from 500 to 1000000 K after the colon.");
        result.temperature = *temperature;
        return result;
    }
    result.kind = SolarSpectrum::Kind::factors;
    for (const auto& word : splitAtCommas(text)) {
        const auto factor = parseNumber(word);
        if (!factor || *factor < 0)
            throw sky::UsageError("`" + std::string(text) +
                                  "` is not understood; expected `model`, `flat`, `black-body:5772` or factors, not "
                                  "negative, separated by commas.");
        result.factors.push_back(*factor);
    }
    return result;
}

std::string toText(const SolarSpectrum& spectrum)
{
    switch (spectrum.kind) {
    case SolarSpectrum::Kind::model: return "model";
    case SolarSpectrum::Kind::flat: return "flat";
    case SolarSpectrum::Kind::blackBody: return std::string(blackBodyPrefix) + toText(spectrum.temperature);
    case SolarSpectrum::Kind::factors: break;
    }
    std::string text;
    for (const double factor : spectrum.factors)
        text += (text.empty() ? "" : ",") + toText(factor);
    return text;
}

std::vector<double> solarFactors(const SolarSpectrum& spectrum, const std::vector<double>& wavelengthsNm,
                                 const std::vector<double>& solarIrradiance)
{
    if (spectrum.kind == SolarSpectrum::Kind::model)
        return {};
    if (spectrum.kind == SolarSpectrum::Kind::factors) {
        if (spectrum.factors.size() != wavelengthsNm.size())
            throw sky::UsageError("The solar spectrum has " + std::to_string(spectrum.factors.size()) + " factors; this model wants " +
                                  std::to_string(wavelengthsNm.size()) + ", one per wavelength.");
        return spectrum.factors;
    }
    std::vector<double> wanted(wavelengthsNm.size(), 1.);
    if (spectrum.kind == SolarSpectrum::Kind::blackBody)
        for (std::size_t i = 0; i < wanted.size(); ++i)
            wanted[i] = planck(wavelengthsNm[i], spectrum.temperature, wavelengthsNm[wanted.size() / 2]);
    const double scale = integral(wavelengthsNm, solarIrradiance) / integral(wavelengthsNm, wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i)
        wanted[i] = solarIrradiance[i] > 0 ? wanted[i] * scale / solarIrradiance[i] : 0;
    return wanted;
}

} // namespace showmysky::app
