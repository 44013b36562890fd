#include "solver/stations.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace sky::solver {

namespace {

/// Of the light that arrives at the start, from each node and from the ground; they add up to one, if there is any.
std::vector<double> sharesOfLight(const physics::RayNodes& ray, const std::vector<double>& groundAlbedo, const bool fromGround)
{
    const std::size_t nodes = ray.nodes.size(), wavelengths = groundAlbedo.size();
    std::vector<double> shares(nodes + 1, 0.);
    for (std::size_t k = 0; k < nodes; ++k)
        for (std::size_t i = k * ray.weights.size() / nodes; i < (k + 1) * ray.weights.size() / nodes; ++i)
            shares[k] += ray.weights[i];
    if (fromGround && ray.hitsGround)
        for (std::size_t w = 0; w < wavelengths; ++w)
            shares[nodes] += ray.groundTransmittance[w] * groundAlbedo[w];
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.);
    for (double& share : shares)
        share = sum > 0 ? share / sum : 0;
    return shares;
}

/// The same at night, when the Sun has set less deep for far points: their light is brighter by e for each `bend`.
std::vector<double> sharesAtNight(std::vector<double> shares, const std::vector<double>& angle, const double bend)
{
    double sum = 0;
    for (std::size_t k = 0; k < shares.size(); ++k)
        sum += shares[k] *= std::exp(angle[k] / bend);
    for (double& share : shares)
        share = sum > 0 ? share / sum : 0;
    return shares;
}

/// Indices of the points that become stations.
std::vector<int> chosenOf(const std::vector<double>& seen, const std::vector<double>& angle, const double bend, const double tolerance)
{
    const int last = static_cast<int>(seen.size()) - 1;
    const auto atNight = sharesAtNight(seen, angle, bend);
    const auto weight = [&](int k) { return std::max(seen[k], atNight[k]); };
    for (int only = 0; only <= last; ++only) { // one will do where all might as well stand at the same angle
        double error = 0;
        for (int k = 0; k <= last; ++k)
            error += weight(k) * std::abs(angle[k] - angle[only]);
        if (last == 0 || (tolerance > 0 && error <= tolerance * bend))
            return {only};
    }
    std::vector<int> chosen{0};
    while (chosen.back() < last) {
        const int a = chosen.back();
        int b = a + 1;
        for (bool fine = tolerance > 0; fine && b < last;) {
            double error = 0;
            for (int k = a + 1; k <= b; ++k)
                error += weight(k) * (angle[k] - angle[a]) * (angle[b + 1] - angle[k]) / 2;
            fine = error <= tolerance * bend * bend;
            b += fine;
        }
        chosen.push_back(b);
    }
    return chosen;
}

} // namespace

Stations::Stations(const physics::RayNodes& ray, const std::vector<double>& groundAlbedo, const bool fromGround, const double bend,
                   const double tolerance)
{
    const auto seen = sharesOfLight(ray, groundAlbedo, fromGround);
    const int points = static_cast<int>(seen.size());
    const auto place = [&](int k) { return k < points - 1 ? ray.nodes[k] : ray.ground; };
    int last = points - 1;
    while (last > 0 && seen[last] == 0)
        --last;

    // Angle at the planet's centre between the start and each point.
    const double mu = ray.nodes.front().mu, sine = std::sqrt(std::max(0., 1 - mu * mu));
    std::vector<double> angle(points, 0.);
    for (int k = 0; k <= last; ++k)
        angle[k] = std::atan2(place(k).nuScale * sine, place(k).sunScale + place(k).nuScale * mu);

    const auto chosen = chosenOf(std::vector<double>(seen.begin(), seen.begin() + last + 1), angle, bend, tolerance);
    for (const int k : chosen)
        places.push_back(place(k));
    shares.resize(points, {0, 0, 0, 0, false});
    std::vector<int> nodesAt(chosen.size(), 0);
    for (int k = 0, station = 0; k <= last; ++k) {
        if (station + 1 < static_cast<int>(chosen.size()) && k == chosen[station + 1])
            ++station;
        double x = 0;
        if (k != chosen[station] && chosen.size() > 1) { // then there is a next one
            const double from = angle[chosen[station]], to = angle[chosen[station + 1]];
            x = to > from ? std::clamp((angle[k] - from) / (to - from), 0., 1.) : 0;
        }
        shares[k] = {station, static_cast<float>(1 - x), static_cast<float>(x), static_cast<float>(seen[k]), false};
        if (seen[k] > 0) {
            ++nodesAt[station];
            if (x > 0)
                ++nodesAt[station + 1];
        }
    }
    for (auto& share : shares)
        share.alone = share.seen > 0 && share.farther == 0 && nodesAt[share.station] == 1;
}

} // namespace sky::solver
