#include "solver/medium_tables.hpp"
#include "base/angles.hpp"
#include "gl/buffer.hpp"
#include "gl/program.hpp"
#include "physics/harmonics.hpp"
#include "physics/optics.hpp"
#include "sky_shaders.hpp"
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sky::solver {

namespace {

using base::pi;
constexpr int angleCount = 1201;
/// Two tenths of what the solver's own grids resolve.
constexpr double densityTolerance = 1e-4;
constexpr std::size_t mostAltitudes = 20000;

std::string number(double value)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.9e", value);
    return text;
}

std::string brief(double value)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

/// All blocks of one description as one compute program.
class Evaluator
{
public:
    Evaluator(const atmo::Description& description, const gl::Api& api)
        : api_(api), species_(static_cast<int>(description.scatterers.size() + description.absorbers.size())),
          scatterers_(static_cast<int>(description.scatterers.size())), program_(build(description, api))
    {
    }

    /// Number densities at the altitudes, [species][altitudes].
    std::vector<float> densities(const std::vector<float>& altitudes)
    {
        const auto results = run(altitudes, false, {}, species_);
        std::vector<float> values(results.size() / 4);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = results[4 * i];
        return values;
    }

    /// Phase functions, [scatterer][cosines][4].
    std::vector<float> phases(const std::vector<float>& cosines, const std::array<float, 4>& wavelengths)
    {
        return run(cosines, true, wavelengths, scatterers_);
    }

private:
    static gl::Program build(const atmo::Description& description, const gl::Api& api)
    {
        std::vector<gl::Snippet> snippets;
        std::string text, density = "float numberDensityOf(int species, float altitude)\n{\n",
                          phase = "vec4 phaseFunctionOf(int species, float dotViewSun)\n{\n";
        int index = 0;
        const auto block = [&](const atmo::CodeBlock& code, const std::string& name, const std::string& signature) {
            snippets.push_back({name, code.text, code.file, code.firstLine});
            text += signature + "\n{\n#include \"user:" + name + "\"\n}\n";
        };
        const auto addDensity = [&](const atmo::CodeBlock& code) {
            const std::string suffix = std::to_string(index);
            block(code, "density" + suffix, "float numberDensity" + suffix + "(float altitude)");
            density += "    if (species == " + suffix + ")\n        return numberDensity" + suffix + "(altitude);\n";
        };
        for (const auto& scatterer : description.scatterers) {
            const std::string suffix = std::to_string(index);
            addDensity(scatterer.numberDensity);
            block(scatterer.phaseFunction, "phase" + suffix, "vec4 phaseFunction" + suffix + "(float dotViewSun)");
            phase += "    if (species == " + suffix + ")\n        return phaseFunction" + suffix + "(dotViewSun);\n";
            ++index;
        }
        for (const auto& absorber : description.absorbers) {
            addDensity(absorber.numberDensity);
            ++index;
        }
        text += density + "    return 0.0;\n}\n" + phase + "    return vec4(0.0);\n}\n";
        const auto source = [&text](std::string_view path) {
            return path == "generated/medium_functions.glsl" ? std::string_view(text) : shaders::source(path);
        };
        return gl::ProgramBuilder(api, source)
            .compute("medium", "solve/medium.comp",
                     {{"EARTH_RADIUS", number(description.planetRadius)}, {"ATMOSPHERE_HEIGHT", number(description.atmosphereHeight)}},
                     snippets);
    }

    std::vector<float> run(const std::vector<float>& arguments, bool phase, const std::array<float, 4>& wavelengths, int species)
    {
        if (species == 0 || arguments.empty())
            return {};
        const gl::Buffer in(api_, "medium arguments", arguments);
        const gl::Buffer out(api_, "medium results", arguments.size() * species * 4 * sizeof(float));
        in.bindStorage(0);
        out.bindStorage(1);
        program_.set("wavelengths", wavelengths);
        program_.set("count", static_cast<int>(arguments.size()));
        program_.set("phase", phase ? 1 : 0);
        const gl::Bound pass(program_);
        program_.dispatchOver(static_cast<unsigned>(arguments.size()), static_cast<unsigned>(species));
        gl::memoryBarrier(api_);
        gl::checkErrors(api_, "medium");
        return out.download();
    }

    gl::Api api_;
    int species_, scatterers_;
    gl::Program program_;
};

const atmo::CodeBlock& densityBlock(const atmo::Description& d, std::size_t species)
{
    return species < d.scatterers.size() ? d.scatterers[species].numberDensity : d.absorbers[species - d.scatterers.size()].numberDensity;
}

struct Sample {
    float altitude;
    std::vector<float> densities;
};

/// Samples until log-linear interpolation between neighbours is good enough, or neighbours touch.
std::vector<Sample> sampleDensities(const atmo::Description& description, Evaluator& evaluator)
{
    const std::size_t species = description.scatterers.size() + description.absorbers.size();
    const double top = description.atmosphereHeight;
    std::vector<float> fresh;
    for (int i = 0; i <= 400; ++i) {
        fresh.push_back(static_cast<float>(top * i / 400));
        fresh.push_back(static_cast<float>(top * std::pow(i / 400., 4)));
    }
    fresh.push_back(static_cast<float>(top));
    std::sort(fresh.begin(), fresh.end());
    fresh.erase(std::unique(fresh.begin(), fresh.end()), fresh.end());

    std::vector<Sample> samples;
    std::vector<double> greatest(species, 0.);
    std::vector<bool> settled; // interval after sample i needs no more nodes
    while (!fresh.empty()) {
        const auto values = evaluator.densities(fresh);
        std::vector<Sample> added;
        for (std::size_t i = 0; i < fresh.size(); ++i) {
            Sample sample{fresh[i], std::vector<float>(species)};
            for (std::size_t s = 0; s < species; ++s) {
                const float n = values[s * fresh.size() + i];
                if (!std::isfinite(n) || n < 0) {
                    const auto& block = densityBlock(description, s);
                    throw AtmoError({block.file, block.firstLine, 0},
                                    "this number density is " + brief(double(n)) + " at an altitude of " + brief(double(fresh[i])) +
                                        " m; it must be finite and not negative everywhere from 0 to " + brief(top) + " m");
                }
                sample.densities[s] = n;
                greatest[s] = std::max(greatest[s], double(n));
            }
            added.push_back(std::move(sample));
        }
        const bool first = samples.empty();
        std::vector<Sample> merged;
        std::merge(samples.begin(), samples.end(), added.begin(), added.end(), std::back_inserter(merged),
                   [](const Sample& a, const Sample& b) { return a.altitude < b.altitude; });

        // An interval is split next round if the sample in its middle was far from the chord of its neighbours.
        std::vector<float> next;
        const auto split = [&](float a, float b) {
            const float middle = 0.5F * (a + b);
            if (middle > a && middle<b&& double(b) - double(a)> 1e-7 * top)
                next.push_back(middle);
        };
        const auto isFresh = [&](float h) { return std::binary_search(fresh.begin(), fresh.end(), h); };
        for (std::size_t i = 1; i + 1 < merged.size(); ++i) {
            if (!first && !isFresh(merged[i].altitude))
                continue;
            const auto& a = merged[i - 1];
            const auto& b = merged[i];
            const auto& c = merged[i + 1];
            const double x = (double(b.altitude) - double(a.altitude)) / (double(c.altitude) - double(a.altitude));
            bool far = false;
            for (std::size_t s = 0; s < species && !far; ++s) {
                const double na = a.densities[s], nb = b.densities[s], nc = c.densities[s];
                const double chord = na > 0 && nc > 0 ? na * std::pow(nc / na, x) : na + x * (nc - na);
                far = std::abs(chord - nb) > densityTolerance * nb + 1e-6 * greatest[s];
            }
            if (far) {
                split(a.altitude, b.altitude);
                split(b.altitude, c.altitude);
            }
        }
        samples = std::move(merged);
        std::sort(next.begin(), next.end());
        next.erase(std::unique(next.begin(), next.end()), next.end());
        if (samples.size() + next.size() > mostAltitudes)
            break;
        fresh = std::move(next);
    }
    return samples;
}

void addPhaseFunctions(const atmo::Description& description, Evaluator& evaluator, physics::Medium& medium,
                       std::vector<std::string>& warnings)
{
    const std::size_t wavelengths = medium.wavelengthsNm.size();
    std::vector<float> cosines;
    for (int k = 0; k < angleCount; ++k) {
        const double theta = pi * std::pow(double(k) / (angleCount - 1), 3);
        medium.scatteringAngles.push_back(theta);
        cosines.push_back(static_cast<float>(std::cos(theta)));
    }
    for (std::size_t s = 0; s < description.scatterers.size(); ++s)
        medium.species[s].phaseFunction.resize(cosines.size() * wavelengths);
    for (std::size_t first = 0; first < wavelengths; first += 4) {
        std::array<float, 4> set{};
        for (std::size_t c = 0; c < 4; ++c)
            set[c] = static_cast<float>(medium.wavelengthsNm[std::min(first + c, wavelengths - 1)]);
        const auto values = evaluator.phases(cosines, set);
        for (std::size_t s = 0; s < description.scatterers.size(); ++s)
            for (std::size_t k = 0; k < cosines.size(); ++k)
                for (std::size_t c = 0; c < 4 && first + c < wavelengths; ++c) {
                    const float p = values[(s * cosines.size() + k) * 4 + c];
                    if (!std::isfinite(p) || p < 0) {
                        const auto& block = description.scatterers[s].phaseFunction;
                        throw AtmoError({block.file, block.firstLine, 0},
                                        "this phase function is " + brief(double(p)) + " at a scattering angle of " +
                                            brief(medium.scatteringAngles[k] * 180 / pi) + " degrees and " +
                                            brief(medium.wavelengthsNm[first + c]) + " nm; it must be finite and not negative");
                    }
                    medium.species[s].phaseFunction[k * wavelengths + first + c] = double(p);
                }
    }
    for (std::size_t s = 0; s < description.scatterers.size(); ++s) {
        auto& species = medium.species[s];
        double worst = 1;
        for (std::size_t w = 0; w < wavelengths; ++w) {
            const double integral = physics::phaseMoments(medium, species, static_cast<int>(w), 0)[0];
            if (!(integral > 0)) {
                const auto& block = description.scatterers[s].phaseFunction;
                throw AtmoError({block.file, block.firstLine, 0}, "this phase function is zero in all directions; its integral "
                                                                  "over the sphere must be 1");
            }
            // Always: in deep air that absorbs nothing, a thousandth more of each event would be light from nothing.
            for (std::size_t k = 0; k < cosines.size(); ++k)
                species.phaseFunction[k * wavelengths + w] /= integral;
            if (std::abs(integral - 1) > phaseNormalisationTolerance && std::abs(std::log(integral)) > std::abs(std::log(worst)))
                worst = integral;
        }
        if (worst != 1)
            warnings.push_back("The phase function of \"" + species.name + "\" integrates to " + brief(worst) +
                               " over the sphere instead of 1; it was divided by that.");
        species.achromatic = true;
        for (std::size_t k = 0; k < cosines.size() && species.achromatic; ++k)
            for (std::size_t w = 1; w < wavelengths; ++w)
                if (species.phaseFunction[k * wavelengths + w] != species.phaseFunction[k * wavelengths])
                    species.achromatic = false;
    }
}

/// Largest vertical optical depth of a species. From there on along the ground the air of a large planet has 1e11.
constexpr double mostOpticalDepth = 1e6;

void checkOpticalDepths(const atmo::Description& description, const physics::Medium& medium)
{
    for (std::size_t s = 0; s < medium.species.size(); ++s) {
        const auto& species = medium.species[s];
        const auto& sigma = species.extinctionCrossSection;
        const double depth = physics::verticalColumn(medium, species) * *std::max_element(sigma.begin(), sigma.end());
        if (!(depth <= mostOpticalDepth)) {
            const auto& block = densityBlock(description, s);
            throw AtmoError({block.file, block.firstLine, 0}, "with this number density \"" + species.name +
                                                                  "\" has a vertical optical depth of " + brief(depth) +
                                                                  "; it must be at most " + brief(mostOpticalDepth));
        }
    }
}

} // namespace

physics::Medium evaluateMedium(const atmo::Description& description, const gl::Api& api, std::vector<std::string>& warnings)
{
    Evaluator evaluator(description, api);
    physics::Medium medium;
    medium.planetRadius = description.planetRadius;
    medium.topOfAtmosphere = description.atmosphereHeight;
    medium.sunAngularRadius = description.sunAngularRadius();
    medium.wavelengthsNm = description.wavelengths.values();
    medium.solarIrradiance = description.solarIrradiance;
    medium.groundAlbedo = description.groundAlbedo;
    for (const auto& scatterer : description.scatterers) {
        physics::Species species;
        species.name = scatterer.name;
        species.smooth = scatterer.phaseFunctionType == atmo::PhaseFunctionType::Smooth;
        for (const double lambda : medium.wavelengthsNm)
            species.extinctionCrossSection.push_back(scatterer.crossSectionAt1um * std::pow(lambda / 1000, -scatterer.angstromExponent));
        species.singleScatteringAlbedo = scatterer.singleScatteringAlbedo;
        medium.species.push_back(std::move(species));
    }
    for (const auto& absorber : description.absorbers) {
        physics::Species species;
        species.name = absorber.name;
        species.extinctionCrossSection = absorber.crossSection;
        species.singleScatteringAlbedo.assign(medium.wavelengthsNm.size(), 0.);
        medium.species.push_back(std::move(species));
    }
    const auto samples = sampleDensities(description, evaluator);
    for (const auto& sample : samples) {
        medium.altitudes.push_back(double(sample.altitude));
        for (std::size_t s = 0; s < medium.species.size(); ++s)
            medium.species[s].numberDensity.push_back(double(sample.densities[s]));
    }
    medium.altitudes.back() = description.atmosphereHeight;
    checkOpticalDepths(description, medium);
    addPhaseFunctions(description, evaluator, medium, warnings);
    return medium;
}

} // namespace sky::solver
