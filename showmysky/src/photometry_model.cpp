#include "photometry_model.hpp"
#include "base/error.hpp"
#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "physics/colour.hpp"
#include <algorithm>

namespace showmysky {

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
}

} // namespace showmysky
