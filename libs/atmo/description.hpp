#pragma once
// The typed, validated content of a .atmo file. SI units and radians; wavelengths in nanometres.

#include <optional>
#include <string>
#include <vector>

namespace sky::atmo {

/// One value per wavelength of the description's grid.
using Spectrum = std::vector<double>;

/// Uniform grid of wavelengths, nanometres.
struct Wavelengths {
    double minNm = 0;
    double maxNm = 0;
    int count = 0;
    /// Wavelength `i`, nm, 0 <= i < count.
    double at(int i) const { return count > 1 ? minNm + i * (maxNm - minNm) / (count - 1) : minNm; }
    std::vector<double> values() const
    {
        std::vector<double> all;
        for (int i = 0; i < count; ++i)
            all.push_back(at(i));
        return all;
    }
    bool operator==(const Wavelengths&) const = default;
};

/// A block of GLSL as the user wrote it. `firstLine` is the 1-based line of the .atmo file on which `text` begins.
struct CodeBlock {
    std::string text;
    std::string file;
    int firstLine = 1;
    /// Two blocks are equal if their text is; where they stood does not matter.
    bool operator==(const CodeBlock& other) const { return text == other.text; }
};

enum class PhaseFunctionType { General, Achromatic, Smooth };

struct Scatterer {
    std::string name;
    CodeBlock numberDensity; ///< float altitude (m) -> float, m^-3
    CodeBlock phaseFunction; ///< float dotViewSun -> vec4, sr^-1
    PhaseFunctionType phaseFunctionType = PhaseFunctionType::General;
    double crossSectionAt1um = 0;          ///< extinction, m^2
    double angstromExponent = 0;           ///< sigma = sigma_1um (lambda / 1 um)^-exponent
    Spectrum singleScatteringAlbedo;       ///< 0..1
    bool needsInterpolationGuides = false; ///< accepted; nothing is left to guide
    bool operator==(const Scatterer&) const = default;
};

struct Absorber {
    std::string name;
    CodeBlock numberDensity; ///< float altitude (m) -> float, m^-3
    Spectrum crossSection;   ///< m^2
    bool operator==(const Absorber&) const = default;
};

/// Sizes of 2D to 4D tables, texels.
struct Size2D {
    int zenithAngle = 0, altitude = 0;
    bool operator==(const Size2D&) const = default;
};
struct SizeScattering {
    int viewZenithAngle = 0, dotViewSun = 0, sunZenithAngle = 0, altitude = 0;
    bool operator==(const SizeScattering&) const = default;
};
struct SizeEclipsed {
    int relativeAzimuth = 0, viewZenithAngle = 0;
    bool operator==(const SizeEclipsed&) const = default;
};
struct SizeEclipsedDouble {
    int relativeAzimuth = 0, viewZenithAngle = 0, sunZenithAngle = 0;
    int azimuthPairs = 0, elevationPairs = 0; ///< "number of ... pairs to sample"
    bool operator==(const SizeEclipsedDouble&) const = default;
};

struct Description {
    int version = 6;

    double planetRadius = 0;      ///< m ("Earth radius")
    double atmosphereHeight = 0;  ///< m
    double sunDistance = 0;       ///< m ("Earth-Sun distance")
    double moonDistance = 0;      ///< m ("Earth-Moon distance")
    double moonRadius = 1737.4e3; ///< m (extension: "moon radius")

    int scatteringOrders = 0;         ///< ignored where allScatteringOrders
    bool allScatteringOrders = false; ///< extension: "scattering orders: all"

    Wavelengths wavelengths;
    Spectrum solarIrradiance;        ///< W m^-2 nm^-1
    Spectrum groundAlbedo;           ///< 0..1
    Spectrum lightPollutionRadiance; ///< W m^-2 sr^-1 nm^-1 per cd m^-2; empty if the description has none

    Size2D transmittanceSize;
    Size2D irradianceSize;
    SizeScattering scatteringSize;
    SizeEclipsed eclipsedScatteringSize;
    SizeEclipsedDouble eclipsedDoubleScatteringSize;
    Size2D lightPollutionSize;

    int transmittanceIntegrationPoints = 0;
    int radialIntegrationPoints = 0;
    int angularIntegrationPoints = 0;
    int eclipseAngularIntegrationPoints = 0;
    int lightPollutionAngularIntegrationPoints = 0;

    std::vector<Scatterer> scatterers;
    std::vector<Absorber> absorbers;

    /// Angular radius of the Sun, rad: 695700 km / distance (IAU 2015 B3 nominal solar radius).
    double sunAngularRadius() const { return 695700e3 / sunDistance; }

    bool operator==(const Description&) const = default;
};

} // namespace sky::atmo
