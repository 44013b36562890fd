#pragma once
// Light of cities: what a camera sees of glowing discs on the ground and of the air above them.

#include "physics/city.hpp"
#include "showmysky/settings.hpp"
#include "sky_view.hpp"
#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace showmysky {

/// Azimuths of the table of city light: a whole turn from North over East, the first again at the end.
constexpr int cityAzimuths = 257;
/// Samples of a city's luminance from its nearest to its farthest edge.
constexpr int cityColourCount = 8;

/// A disc on the ground as the painter draws it.
struct DrawnCity {
    double angle = 0, azimuth = 0, radius = 0; ///< of its centre; angles at the planet's centre, rad
    std::array<Texel, cityColourCount> colours{};
};

/// Light of the cities of a scene; nothing if `discs` is empty.
struct CityLight {
    double altitude = -1;
    std::vector<City> cities;
    ViewTable air; ///< cityAzimuths wide
    std::vector<DrawnCity> discs;
};

/// Answers for one medium. Const functions may be called from many threads at once.
class Cities
{
public:
    /// \param modelSpectrum of the model's light pollution, per cd m^-2; may be empty
    Cities(const sky::physics::Medium& medium, std::vector<double> modelSpectrum);

    /// Empty if these cities can be drawn, otherwise a sentence that says why not.
    std::string whyNot(const std::vector<City>& cities) const;
    /// What a camera sees of cities: some seconds for the first of a radius, some tenths for others.
    ///   stop  asked every few milliseconds; throws sky::base::Stopped
    CityLight light(const std::vector<City>& cities, double altitude, const sky::base::StopRequest& stop = {}) const;

    /// Radiance in a direction, the discs in direct view included, W m^-2 sr^-1 nm^-1: added to `result`.
    void addRadiance(const std::vector<City>& cities, double altitude, const std::array<double, 3>& direction, double* result) const;

private:
    /// Adds the air's part of one city to a table of views and cityAzimuths; also the ground, as far as the air lights it.
    void addTo(ViewTable& table, const City& city, double altitude, const sky::base::StopRequest& stop) const;
    DrawnCity drawn(const City& city, double altitude) const;
    std::shared_ptr<const sky::physics::CityField> field(double radius, const sky::base::StopRequest& stop = {}) const;
    std::vector<double> spectrumOf(const City& city) const;
    Texel luminanceOf(const double* radiance, const std::vector<double>& spectrum) const;

    sky::physics::CityAir air_;
    std::vector<double> modelSpectrum_;
    std::vector<std::array<double, 4>> weights_; ///< [wavelength]: X, Y, Z, scotopic of unit radiance
    mutable std::mutex mutex_;
    mutable std::vector<std::shared_ptr<const sky::physics::CityField>> fields_; ///< the last used at the end
};

} // namespace showmysky
