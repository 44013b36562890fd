#include "light_meter.hpp"

#include "base/angles.hpp"
#include "physics/colour.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky::app::preview {

std::optional<Reading> readLight(Sky& sky, const std::array<double, 2>& share)
{
    using sky::base::degree;
    const int x = std::clamp(static_cast<int>(share[0] * sky.width()), 0, sky.width() - 1);
    const int y = std::clamp(static_cast<int>(share[1] * sky.height()), 0, sky.height() - 1);
    const auto direction = sky.viewDirection(x, y);
    if (direction == std::array<double, 3>{})
        return std::nullopt;
    Reading reading;
    const double azimuth = std::atan2(-direction[1], direction[0]) / degree; // y points West
    reading.azimuth = azimuth < 0 ? azimuth + 360 : azimuth;
    reading.elevation = std::asin(std::clamp(direction[2], -1., 1.)) / degree;
    reading.luminance = sky.pixelLuminance(x, y);
    const sky::physics::XYZ xyz{static_cast<double>(reading.luminance.x), static_cast<double>(reading.luminance.y),
                                static_cast<double>(reading.luminance.z)};
    reading.xy = sky::physics::chromaticity(xyz);
    reading.colourTemperature = sky::physics::correlatedColourTemperature(xyz);
    reading.wavelengths = sky.wavelengths();
    try {
        reading.radiance = sky.spectralRadiance(direction);
    } catch (const Error& error) {
        reading.problem = error.what();
    }
    return reading;
}

} // namespace showmysky::app::preview
