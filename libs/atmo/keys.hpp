#pragma once
// The keys of the language as tables: reading, writing and suggesting all follow them.

#include "atmo/description.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace sky::atmo {

/// A key whose value is a whole number.
struct WholeNumberKey {
    std::string_view key;
    int fallback; ///< where the key is missing: these keys only tune the numerics
    int min, max;
    bool even;
    int& (*field)(Description&);
};

/// A key whose value is a length.
struct LengthKey {
    std::string_view key;
    double min, max;                ///< m
    std::string_view range;         ///< the same in words
    std::optional<double> fallback; ///< none: the key is mandatory
    double& (*field)(Description&);
};

std::span<const WholeNumberKey> wholeNumberKeys();
std::span<const LengthKey> lengthKeys();

/// The keys at the top level beside those in the two tables, sections not counted.
namespace key {
inline constexpr std::string_view version = "version";
inline constexpr std::string_view scatteringOrders = "scattering orders";
inline constexpr std::string_view wavelengths = "wavelengths";
inline constexpr std::string_view solarIrradiance = "solar irradiance at TOA";
inline constexpr std::string_view groundAlbedo = "ground albedo";
inline constexpr std::string_view lightPollution = "light pollution relative radiance";
// In a section.
inline constexpr std::string_view numberDensity = "number density";
inline constexpr std::string_view phaseFunction = "phase function";
inline constexpr std::string_view phaseFunctionType = "phase function type";
inline constexpr std::string_view crossSectionAt1um = "cross section at 1 um";
inline constexpr std::string_view angstromExponent = "angstrom exponent";
inline constexpr std::string_view singleScatteringAlbedo = "single scattering albedo";
inline constexpr std::string_view interpolationGuides = "needs interpolation guides";
inline constexpr std::string_view crossSection = "cross section";
} // namespace key

std::span<const std::string_view> topLevelKeys(); ///< all of them, of the tables too
std::span<const std::string_view> scattererKeys();
std::span<const std::string_view> absorberKeys();

/// Names of `phase function type`, in the order of the enumeration.
inline constexpr std::string_view phaseFunctionTypeNames[] = {"general", "achromatic", "smooth"};

inline constexpr int supportedVersion = 6;
inline constexpr int mostWavelengths = 64;
inline constexpr int mostScatteringOrders = 1000;
inline constexpr int mostSpecies = 64;

/// The candidate that `word` is most probably a misspelling of; empty if none is near.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

} // namespace sky::atmo
