#include "photometry_model.hpp"
#include "base/angles.hpp"
#include "base/error.hpp"
#include "base/not_negative.hpp"
#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "physics/colour.hpp"
#include "showmysky/error.hpp"
#include <algorithm>
#include <cmath>
#include <sstream>

namespace showmysky {

namespace {

using sky::base::pi;

/// Of the brightest field, that may be missing where there is no light: the degrees of a phase function cut short go below zero opposite to sharp
/// peaks. Of 27 generated scenes ten had such places, in the whole sky of 4e-4 of the brightest field at most, in multiple scattering alone of 6e-3;
/// air as the Earth's, hazy or cloudy has none.
constexpr double mostMissing = 0.1;

/// PhotometryModel::brightest; where there are no moments as if all sunlight came from everywhere.
std::vector<double> brightestField(const std::optional<sky::physics::Moments>& moments, const int wavelengths)
{
    std::vector<double> result(static_cast<std::size_t>(wavelengths), moments ? 0 : 1 / (4 * pi));
    for (int a = 0; moments && a < moments->grid.altitudeCount(); ++a)
        for (int j = 0; j < moments->grid.sunCount(); ++j)
            for (int w = 0; w < wavelengths; ++w)
                result[static_cast<std::size_t>(w)] =
                    std::max(result[static_cast<std::size_t>(w)], std::exp(moments->at(a, j)[w]) / std::sqrt(4 * pi));
    return result;
}

[[noreturn]] void failBy(const char* what, const double wavelengthNm, const double value, const std::string& directory)
{
    std::ostringstream sentence;
    sentence << what << " at " << wavelengthNm << " nm came out as " << value << ". Either the model '" << directory
             << "' holds numbers beyond all bounds, then compute it anew, or this is an error of ShowMySky.";
    throw Error(ErrorKind::other, sentence.str());
}

} // namespace

PhotometryModel::PhotometryModel(const std::string& directory)
    : model(sky::model::Model::open(directory)), medium(sky::model::readMedium(model)), profile(medium),
      optics(sky::model::readOptics(model, medium)), aureole(medium, optics), sun(profile, optics, medium.sunAngularRadius),
      onceAtMost(sky::model::scattersOnceAtMost(model.manifest())), evaluator(medium, profile, optics, sun, &aureole),
      luminanceWeights(sky::physics::luminanceWeights(medium.wavelengthsNm))
{
    if (model.hasTable("moments")) {
        moments = sky::model::readMoments(model);
        if (moments->degree != optics.degree)
            throw sky::ModelError(directory + ": the moments are of degree " + std::to_string(moments->degree) +
                                  ", the setting \"moments.degree\" says " + std::to_string(optics.degree) + ".");
    }
    if (sky::physics::truncates(optics)) {
        trueOptics = sky::physics::makeOptics(medium, optics.degree, false);
        trueSun.emplace(profile, *trueOptics, medium.sunAngularRadius);
    }
    brightest = brightestField(moments, medium.wavelengthCount());
}

void PhotometryModel::finishRadiance(double* const spectrum) const
{
    for (std::size_t w = 0; w < brightest.size(); ++w) {
        if (spectrum[w] < -mostMissing * brightest[w])
            failBy("The radiance", medium.wavelengthsNm[w], spectrum[w] * medium.solarIrradiance[w], model.directory().string());
        spectrum[w] = sky::base::notNegative(spectrum[w] * medium.solarIrradiance[w]);
    }
}

void PhotometryModel::checkAnswer(const char* const what, const double* const spectrum) const
{
    for (std::size_t w = 0; w < brightest.size(); ++w)
        if (!std::isfinite(spectrum[w]))
            failBy(what, medium.wavelengthsNm[w], spectrum[w], model.directory().string());
}

} // namespace showmysky
