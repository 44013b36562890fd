#pragma once

namespace sky::eclipse {

/// How finely the field around an observer is computed. docs/eclipses.md has what each costs and brings. Errors that eclipsed
/// and uneclipsed light have in common cancel, so that much less than the ordinary solver's settings will do.
struct FieldSettings {
    int altitudes = 14;         ///< levels, over the air that scatters light worth mentioning, before the medium asks for more
    int along = 17;             ///< points in the mirror plane, towards the Sun and away, >= 2
    int across = 9;             ///< points away from the mirror plane, >= 2
    double reach = 1200e3;      ///< m: how far the grid goes beyond the observer and the shadow
    double core = 50e3;         ///< m: within about this distance of both the points stand evenly, then ever wider
    int degree = 5;             ///< of the harmonics, at most mostDegree and that of the optics
    int leastDegree = 3;        ///< every event has one degree less than the last, but this at least: scattering makes light even
    int groundDirections = 6;   ///< zenith angles from nadir to the horizon
    int limbDirections = 2;     ///< from the horizon to the horizontal
    int skyDirections = 6;      ///< from the horizontal to the zenith
    int azimuths = 12;          ///< over the whole turn, a multiple of 4
    int directNodes = 24;       ///< along a ray, for sunlight
    int nodes = 12;             ///< along a ray, for scattered light
    int sunlightAltitudes = 32; ///< levels at which sunlight is known
    int sunlightRefinement = 1; ///< points of sunlight per point of the grid, along and across
    double chords = 5e-3;       ///< share of the light of a ray that may be gained where nodes share places (eclipse/stations)
    double directChords = 1e-3; ///< the same of sunlight
    int viewNodes = 32;         ///< along a ray that is seen
};

/// Largest degree of the harmonics.
constexpr int mostDegree = 6;

/// Events of scattering or reflection that are counted.
struct Orders {
    int orders = 4;   ///< of the light that is seen: the field has one event less. 2: light of second order alone
    bool all = false; ///< go on until later events no longer change quotients by the tolerance, and close the series as a geometric one
    double tolerance = 5e-3; ///< relative, rms over some directions of view; with `all`
};

} // namespace sky::eclipse
