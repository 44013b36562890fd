#pragma once
// A model as photometry needs it: medium, optics, sunlight and moments, in double precision.

#include "model/model.hpp"
#include "physics/sky.hpp"
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace showmysky {

struct PhotometryModel {
    /// throws sky::ModelError
    explicit PhotometryModel(const std::string& directory);
    PhotometryModel(const PhotometryModel&) = delete;
    PhotometryModel& operator=(const PhotometryModel&) = delete;

    sky::model::Model model;
    sky::physics::Medium medium;
    sky::physics::Profile profile;
    sky::physics::Optics optics;                    ///< peaks truncated, as the moments were computed
    sky::physics::Aureole aureole;                  ///< of these optics
    sky::physics::SunTable sun;                     ///< through them
    std::optional<sky::physics::Moments> moments;   ///< empty if the model has none
    bool onceAtMost;                                ///< no light is scattered twice: no moments are missing
    std::optional<sky::physics::Optics> trueOptics; ///< only where they differ: nothing truncated
    std::optional<sky::physics::SunTable> trueSun;
    sky::physics::SkyEvaluator evaluator;
    std::vector<std::array<double, 4>> luminanceWeights; ///< [wavelength]{X, Y, Z, scotopic}
    std::vector<double> brightest; ///< [wavelength], mean radiance of the field where that is largest, per unit solar irradiance

    /// Light as it was added up, per unit solar irradiance: made W m^-2 sr^-1 nm^-1, and darkness where the degrees of a phase function cut
    /// short come to less than none.
    ///   throws  other: far too much less than none; what isn't a number is left to checkAnswer()
    void finishRadiance(double* spectrum) const;
    /// Every number that leaves the library is one.
    ///   what    the radiance, ..     throws  other
    void checkAnswer(const char* what, const double* spectrum) const;

    /// Direct sunlight as it is, without what truncated peaks count as unscattered.
    const sky::physics::SunTable& directSun() const { return trueSun ? *trueSun : sun; }
};

} // namespace showmysky
