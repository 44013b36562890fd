#pragma once
// Cities from the plain C interfaces.

#include "showmysky/city.h"
#include "showmysky/settings.hpp"

namespace showmysky {

inline std::vector<City> citiesOf(const showmysky_city* cities, std::size_t count)
{
    std::vector<City> result;
    for (std::size_t i = 0; i < count; ++i) {
        const showmysky_city& c = cities[i];
        result.push_back({c.distance, c.azimuth, c.radius, c.luminance, {}});
        if (c.spectrum)
            result.back().spectrum.assign(c.spectrum, c.spectrum + c.spectrum_count);
    }
    return result;
}

} // namespace showmysky
