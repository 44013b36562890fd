#include "atmosphere.hpp"

#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "physics/colour.hpp"

namespace showmysky {

Atmosphere::Atmosphere(const std::string& directory)
    : model(sky::model::Model::open(directory)), medium(sky::model::readMedium(model)), profile(medium),
      optics(sky::model::readOptics(model, medium)), aureole(medium, optics)
{
}

std::vector<std::array<float, 4>> Atmosphere::luminanceWeights(const std::vector<double>& factors) const
{
    const auto weights = sky::physics::luminanceWeights(medium.wavelengthsNm);
    std::vector<std::array<float, 4>> result(weights.size());
    for (std::size_t w = 0; w < weights.size(); ++w)
        for (std::size_t c = 0; c < 4; ++c)
            result[w][c] = static_cast<float>(weights[w][c] * medium.solarIrradiance[w] * (factors.empty() ? 1 : factors[w]));
    return result;
}

std::string Atmosphere::singleScatteringTable(int scatterer) const
{
    return "single-scattering/" + medium.species[static_cast<std::size_t>(optics.scatterers[static_cast<std::size_t>(scatterer)])].name;
}

} // namespace showmysky
