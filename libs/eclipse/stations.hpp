#pragma once
// Where along the ground the light of a ray's nodes is gathered. A steep ray hardly leaves its place, and far nodes carry little
// light: fewer places than nodes are enough, and shifting planes of points to such places is what a sweep spends its time on.

#include <vector>

namespace sky::eclipse {

/// A place on a ray: between levels `level` and `level + 1`, `share` of the way; `distance` along the ground from the ray's start.
struct Place {
    int level;
    float share, distance;
};

/// Some levels, as they are seen at one distance.
struct Station {
    float distance;   ///< along the ground from the ray's start, m
    int first, count; ///< its entries
};

struct Stations {
    std::vector<Station> stations;
    std::vector<int> levels; ///< [entry]
};

/// How nodes are shared out among entries.
struct Sharing {
    Stations places;
    struct Part {
        int node, entry;
        float share;
    };
    std::vector<Part> parts;
};

/// Takes nodes for stations such that light from those in between, shared out linearly among its neighbours, is true to first order
/// in the distance; of second order is left what would be `tolerance` of all light, where light changes by itself within `scale`.
///   nodes   of a ray, in the order of their distances
///   weight  [node], 0..1: largest share of the ray's light, of all wavelengths
///   scale   m
Sharing shareOut(const std::vector<Place>& nodes, const std::vector<double>& weight, double scale, double tolerance);

} // namespace sky::eclipse
