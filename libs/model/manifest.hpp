#pragma once
// manifest.json as a struct: all that a model says about itself. Written last, so a model without one is no model.

#include "model/table.hpp"
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sky::model {

constexpr int formatVersion = 1;

/// One kind of particle, but for what tables hold (number density, phase function).
struct SpeciesInfo {
    std::string name;
    bool scatters = false;
    std::string phaseFunctionType = "none";     ///< "general", "achromatic", "smooth"; "none" if it never scatters
    std::vector<double> singleScatteringAlbedo; ///< [wavelengths], 0..1
    std::vector<double> extinctionCrossSection; ///< [wavelengths], m^2
    bool operator==(const SpeciesInfo&) const = default;
};

/// Something that was not computed, and why.
struct Skipped {
    std::string what;
    std::string why;
    bool operator==(const Skipped&) const = default;
};

/// Size and checksum of a file of the model.
struct FileInfo {
    std::uint64_t bytes = 0;
    std::string xxh3; ///< XXH3, 128 bits, 32 hexadecimal digits, as `xxh128sum` prints it
    bool operator==(const FileInfo&) const = default;
};

struct Manifest {
    std::string generator;                      ///< program and version
    std::string name;                           ///< of the model, for people; may be empty
    double planetRadius = 0;                    ///< m
    double topOfAtmosphere = 0;                 ///< m, altitude
    double sunAngularRadius = 0;                ///< rad
    double sunDistance = 0;                     ///< m
    double moonDistance = 0;                    ///< m, from the planet's centre
    double moonRadius = 0;                      ///< m
    std::vector<double> wavelengthsNm;          ///< [wavelengths], at least one, strictly increasing
    std::vector<double> solarIrradiance;        ///< [wavelengths], W m^-2 nm^-1
    std::vector<double> groundAlbedo;           ///< [wavelengths], 0..1
    std::vector<double> lightPollutionRadiance; ///< [wavelengths], W m^-2 sr^-1 nm^-1 per cd m^-2, or empty
    std::vector<SpeciesInfo> species;
    int scatteringOrders = 0;         ///< orders that the tables hold
    bool allScatteringOrders = false; ///< a closed series: what is beyond scatteringOrders is added as an estimate
    std::vector<Skipped> skipped;
    std::vector<std::string> warnings;
    std::map<std::string, double> estimatedError; ///< relative, by table or regime
    std::map<std::string, std::string> settings;  ///< options that shaped the model

    std::vector<Table> tables;             ///< filled by the writer
    std::map<std::string, FileInfo> files; ///< filled by the writer: every file but manifest.json

    int wavelengthCount() const { return static_cast<int>(wavelengthsNm.size()); }
};

/// The text of manifest.json: the same manifest always gives the same bytes.
std::string writeManifest(const Manifest& manifest);

/// Reads and checks the text of manifest.json; it may come from a stranger.
///   place   named in messages, for instance the path of the file
///   throws  ModelError: place, the entry ("tables[2].axes[0].nodes"), what was found and what was expected
Manifest parseManifest(const std::string& text, const std::string& place);

/// True if the directory holds a manifest.json of this format, of whatever version and in whatever state.
bool isModelDirectory(const std::string& directory);

} // namespace sky::model
