#include "atmo/keys.hpp"

#include "atmo/document.hpp"
#include "base/suggest.hpp"

#include <algorithm>
#include <vector>

namespace sky::atmo {

namespace {

constexpr double astronomicalUnit = 149597870700.0; // m, IAU 2012 resolution B2
constexpr int maxTexels = 16384;                    // along one axis
constexpr int maxPoints = 1'000'000;

using D = Description;

constexpr WholeNumberKey wholeNumbers[] = {
    {"transmittance texture size for VZA", 256, 2, maxTexels, false, [](D& d) -> int& { return d.transmittanceSize.zenithAngle; }},
    {"transmittance texture size for altitude", 64, 2, maxTexels, false, [](D& d) -> int& { return d.transmittanceSize.altitude; }},
    {"irradiance texture size for SZA", 64, 2, maxTexels, false, [](D& d) -> int& { return d.irradianceSize.zenithAngle; }},
    {"irradiance texture size for altitude", 16, 2, maxTexels, false, [](D& d) -> int& { return d.irradianceSize.altitude; }},
    {"scattering texture size for VZA", 128, 4, maxTexels, true, [](D& d) -> int& { return d.scatteringSize.viewZenithAngle; }},
    {"scattering texture size for dot(view,sun)", 8, 2, maxTexels, false, [](D& d) -> int& { return d.scatteringSize.dotViewSun; }},
    {"scattering texture size for SZA", 32, 2, maxTexels, false, [](D& d) -> int& { return d.scatteringSize.sunZenithAngle; }},
    {"scattering texture size for altitude", 32, 2, maxTexels, false, [](D& d) -> int& { return d.scatteringSize.altitude; }},
    {"eclipsed scattering texture size for relative azimuth", 32, 2, maxTexels, false,
     [](D& d) -> int& { return d.eclipsedScatteringSize.relativeAzimuth; }},
    {"eclipsed scattering texture size for VZA", 64, 2, maxTexels, false,
     [](D& d) -> int& { return d.eclipsedScatteringSize.viewZenithAngle; }},
    {"eclipsed double scattering texture size for relative azimuth", 16, 2, maxTexels, false,
     [](D& d) -> int& { return d.eclipsedDoubleScatteringSize.relativeAzimuth; }},
    {"eclipsed double scattering texture size for VZA", 64, 2, maxTexels, false,
     [](D& d) -> int& { return d.eclipsedDoubleScatteringSize.viewZenithAngle; }},
    {"eclipsed double scattering texture size for SZA", 16, 2, maxTexels, false,
     [](D& d) -> int& { return d.eclipsedDoubleScatteringSize.sunZenithAngle; }},
    {"eclipsed double scattering number of azimuth pairs to sample", 2, 1, maxTexels, false,
     [](D& d) -> int& { return d.eclipsedDoubleScatteringSize.azimuthPairs; }},
    {"eclipsed double scattering number of elevation pairs to sample", 10, 1, maxTexels, false,
     [](D& d) -> int& { return d.eclipsedDoubleScatteringSize.elevationPairs; }},
    {"light pollution texture size for VZA", 128, 2, maxTexels, false, [](D& d) -> int& { return d.lightPollutionSize.zenithAngle; }},
    {"light pollution texture size for altitude", 64, 2, maxTexels, false, [](D& d) -> int& { return d.lightPollutionSize.altitude; }},
    {"transmittance integration points", 500, 1, maxPoints, false, [](D& d) -> int& { return d.transmittanceIntegrationPoints; }},
    {"radial integration points", 50, 1, maxPoints, false, [](D& d) -> int& { return d.radialIntegrationPoints; }},
    {"angular integration points", 512, 1, maxPoints, false, [](D& d) -> int& { return d.angularIntegrationPoints; }},
    {"angular integration points for eclipse", 512, 1, maxPoints, false, [](D& d) -> int& { return d.eclipseAngularIntegrationPoints; }},
    {"light pollution angular integration points", 200, 1, maxPoints, false,
     [](D& d) -> int& { return d.lightPollutionAngularIntegrationPoints; }},
};

constexpr LengthKey lengths[] = {
    {"Earth radius", 100e3, 10e9, "from 100 km to 10 Gm", {}, [](D& d) -> double& { return d.planetRadius; }},
    {"atmosphere height", 1, 1e6, "from 1 m to 1 Mm", {}, [](D& d) -> double& { return d.atmosphereHeight; }},
    {"Earth-Sun distance",
     0.5 * astronomicalUnit,
     1e20 * astronomicalUnit,
     "from 0.5 AU to 10^20 AU",
     {},
     [](D& d) -> double& { return d.sunDistance; }},
    {"Earth-Moon distance",
     1e-4 * astronomicalUnit,
     1e20 * astronomicalUnit,
     "from 10^-4 AU to 10^20 AU",
     {},
     [](D& d) -> double& { return d.moonDistance; }},
    // The IAU's mean radius of the Moon.
    {"moon radius", 1, 10e9, "from 1 m to 10 Gm", 1737.4e3, [](D& d) -> double& { return d.moonRadius; }},
};

constexpr std::string_view scattererKeyList[] = {
    key::numberDensity,    key::phaseFunction,          key::phaseFunctionType,   key::crossSectionAt1um,
    key::angstromExponent, key::singleScatteringAlbedo, key::interpolationGuides,
};
constexpr std::string_view absorberKeyList[] = {key::numberDensity, key::crossSection};

} // namespace

std::span<const WholeNumberKey> wholeNumberKeys() { return wholeNumbers; }
std::span<const LengthKey> lengthKeys() { return lengths; }
std::span<const std::string_view> scattererKeys() { return scattererKeyList; }
std::span<const std::string_view> absorberKeys() { return absorberKeyList; }

std::span<const std::string_view> topLevelKeys()
{
    static const std::vector<std::string_view> all = [] {
        std::vector<std::string_view> keys{key::version,         key::scatteringOrders, key::wavelengths,
                                           key::solarIrradiance, key::groundAlbedo,     key::lightPollution};
        for (const WholeNumberKey& entry : wholeNumbers)
            keys.push_back(entry.key);
        for (const LengthKey& entry : lengths)
            keys.push_back(entry.key);
        return keys;
    }();
    return all;
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates)
{
    const std::string wanted = comparable(word);
    std::string_view best;
    int bestDistance = std::max(1, static_cast<int>(wanted.size()) / 3) + 1;
    // Quadratic in the length, so a whole paragraph is not worth a suggestion.
    if (wanted.empty() || wanted.size() > 200)
        return best;
    for (const std::string_view candidate : candidates) {
        const int distance = editDistance(wanted, comparable(candidate));
        if (distance < bestDistance) {
            bestDistance = distance;
            best = candidate;
        }
    }
    return best;
}

} // namespace sky::atmo
