#pragma once
// A complete small description for tests to vary.

#include "atmo/parse.hpp"

#include <stdexcept>
#include <string>

namespace sample {

inline const std::string text = R"(version: 6
Earth radius: 6371 km
atmosphere height: 120 km
Earth-Sun distance: 1 AU
Earth-Moon distance: 384400 km
scattering orders: 4
wavelengths: min=400nm, max=700nm, count=4
solar irradiance at TOA: 1.5, 1.9, 1.8, 1.4
ground albedo: 0.1, 0.2, 0.3, 0.4

Scatterer "molecules":
{
    number density:
    ```
        return 3.08458e25*exp(-altitude/(8.0*km));
    ```
    phase function:
    ```
        return vec4(3.0/(16.0*PI)*(1.0+sqr(dotViewSun)));
    ```
    cross section at 1 um: 0.04022 fm^2
    angstrom exponent: 4
}

Absorber "ozone":
{
    number density:
    ```
        return 370.0*dobsonUnit/(30.0*km);
    ```
    cross section: 1e-27, 1e-25, 4e-25, 2e-26
}
)";

/// The sample with the first `from` replaced by `to`.
inline std::string with(const std::string& from, const std::string& to, std::string in = text)
{
    const std::size_t at = in.find(from);
    if (at == std::string::npos)
        throw std::logic_error("the sample has no '" + from + "'");
    return in.replace(at, from.size(), to);
}

inline sky::atmo::Description parse(const std::string& description, const sky::atmo::ParseOptions& options = {})
{
    return sky::atmo::parse(description, "test.atmo", SKY_TEST_DATA "/corpus", options);
}

} // namespace sample
