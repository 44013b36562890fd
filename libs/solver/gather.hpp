#pragma once
#include "gl/program.hpp"
#include "solver/field.hpp"
#include <functional>
#include <optional>

namespace sky::solver {

/// The Suns and azimuths for which rays gather light.
struct SunSamples {
    int suns, azimuths;
    TexelBuffer sunCosines, azimuthCosines;
    SunSamples(const gl::Api& api, const std::vector<float>& sunCosines, const std::vector<float>& azimuthCosines);
};

/// Where results go: strides in texels for ray, Sun and azimuth.
struct Strides {
    int ray, sun, azimuth;
};

/// Called between dispatches, which are kept short: throws to stop.
using Breath = std::function<void()>;

// Tables as the gathers' shaders read them, wavelengths in sets of four.
/// [altitude][elevation][set] of the table of sunlight
std::vector<float> sunDepthTexels(const Scene& scene);
/// field: [scatterer][l][set], (2l+1)/(4 pi) lambda_l; otherwise [scatterer][angle][set], at the medium's angles
std::vector<float> phaseTexels(const Scene& scene, bool field);
/// [padded wavelength] X, Y, Z, scotopic; empty if `luminance` is
std::vector<std::array<float, 4>> luminanceTexels(const Scene& scene, const std::vector<std::array<double, 4>>& luminance);

/// Light of the first event along rays: solve/direct.comp.
class DirectGather
{
public:
    enum class Purpose {
        field,       ///< all species together, phase functions cut at the degree, sunlit ground included: starts the iteration
        fieldLight,  ///< the same without phase functions, each scatterer and then the ground apart: for PhaseGather
        groundField, ///< the sunlit ground alone
        table        ///< each species apart, see gather()
    };
    /// \param luminance [wavelength] X, Y, Z, scotopic of unit radiance over unit solar irradiance; empty: spectral results
    DirectGather(const gl::Api& api, const Scene& scene, Purpose purpose, const std::vector<std::array<double, 4>>& luminance);

    /// Fills `results`. For each scatterer (in the order of Optics::scatterers; one result in all for a field) a block of
    /// rays x suns x azimuths texels; a texel is one vec4 of luminance or sets() vec4s of radiance per unit solar irradiance.
    ///   withPhase  [scatterer] multiply by the exact phase function
    void gather(const DirectRays& rays, const SunSamples& samples, Strides strides, const std::vector<bool>& withPhase, gl::Buffer& results,
                const Breath& breath);

private:
    gl::Api api_;
    const Scene scene_;
    gl::Program program_;
    std::vector<std::array<double, 4>> luminance_;
    TexelBuffer sunDepths_, phases_;
};

/// Light of the first event at many azimuths from sunlight at few (DirectGather::Purpose::fieldLight): solve/phase.comp. Between those it is
/// a series of cosines, as many as there are.
class PhaseGather
{
public:
    PhaseGather(const gl::Api& api, const Scene& scene, int lightAzimuths, int azimuths);

    /// Fills `results`: rays x suns x azimuths texels, see DirectGather.
    ///   light  [scatterer, then ground][ray][sun][azimuth of the light][set]
    void gather(const DirectRays& rays, const SunSamples& samples, Strides strides, const gl::Buffer& light, gl::Buffer& results,
                const Breath& breath);

private:
    gl::Api api_;
    const Scene scene_;
    int lightAzimuths_;
    gl::Program program_;
    TexelBuffer phases_, azimuthWeights_;
};

/// Light of later events along rays: fold() and solve/scattered.comp.
class ScatteredGather
{
public:
    ScatteredGather(const gl::Api& api, const Scene& scene, const std::vector<std::array<double, 4>>& luminance);

    /// Fills `results`: rays x suns x azimuths texels, see DirectGather.
    ///   azimuthal  highest azimuthal order of the field that counts
    void gather(const ScatteredRays& rays, const FoldField& field, int azimuthal, const SunSamples& samples, Strides strides,
                gl::Buffer& results, const Breath& breath);

private:
    gl::Api api_;
    const Scene scene_;
    int sets_, setsTogether_; // of four wavelengths; of luminance there is one
    gl::Program program_;
    std::vector<std::array<float, 4>> luminance_;
    std::optional<TexelBuffer> source_; // kept between calls: it is large
    std::size_t sourceTexels_ = 0;
};

} // namespace sky::solver
