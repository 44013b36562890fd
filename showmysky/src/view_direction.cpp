#include "view_direction.hpp"
#include "base/angles.hpp"

#include <cmath>

namespace showmysky {

namespace {

using sky::base::pi;

} // namespace

std::array<double, 3> directionOf(double azimuth, double zenithAngle)
{
    const double sine = std::sin(zenithAngle);
    return {std::cos(azimuth) * sine, -std::sin(azimuth) * sine, std::cos(zenithAngle)};
}

std::array<Vector, 3> cameraAxes(const Camera& camera)
{
    const double sine = std::sin(camera.pitch), cosine = std::cos(camera.pitch);
    const double north = std::cos(camera.yaw), west = -std::sin(camera.yaw);
    return {Vector{west, -north, 0}, Vector{-sine * north, -sine * west, cosine}, Vector{cosine * north, cosine * west, sine}};
}

std::array<double, 2> projectionScale(const Camera& camera, double width, double height)
{
    const bool perspective = camera.projection == Projection::perspective;
    const double most = perspective ? pi : 2 * pi + 1e-9;
    if (!(camera.fieldOfView > 0) || !(perspective ? camera.fieldOfView < most : camera.fieldOfView <= most))
        throw Error(ErrorKind::settings, perspective ? "The field of view of a perspective must be between 0 and 180 degrees."
                                                     : "The field of view must be above 0 and at most 360 degrees.");
    const double x = perspective ? std::tan(camera.fieldOfView / 2) : camera.fieldOfView / 2;
    return {x, x * height / width};
}

Vector builtInDirection(const Camera& camera, double width, double height, double x, double y)
{
    const auto scale = projectionScale(camera, width, height);
    const double px = (2 * x / width - 1) * scale[0], py = (2 * y / height - 1) * scale[1];
    Vector own{px, py, 1};
    if (camera.projection == Projection::fisheye) {
        const double angle = std::hypot(px, py);
        if (angle > pi)
            return {};
        const double sinc = angle > 1e-12 ? std::sin(angle) / angle : 1;
        own = {px * sinc, py * sinc, std::cos(angle)};
    } else if (camera.projection == Projection::equirectangular) {
        if (std::abs(py) > pi / 2 || std::abs(px) > pi)
            return {};
        own = {std::cos(py) * std::sin(px), std::sin(py), std::cos(py) * std::cos(px)};
    }
    const auto axes = cameraAxes(camera);
    Vector result{};
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        result[i] = own[0] * axes[0][i] + own[1] * axes[1][i] + own[2] * axes[2][i];
        square += result[i] * result[i];
    }
    for (double& component : result)
        component /= std::sqrt(square);
    return result;
}

} // namespace showmysky
