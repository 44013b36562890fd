#pragma once
// How much of the Sun is left at points of the air, fast: a table over the place between umbra and penumbra.

#include "physics/eclipse.hpp"
#include "physics/limb_darkening.hpp"
#include "sky_view.hpp"

namespace showmysky {

/// Both edges come from the exact cones at each point's depth; between them the fraction is tabulated over
/// sqrt((m - umbra) / (penumbra - umbra)), m the distance from the axis (umbra 0 where
/// the eclipse is annular), and over the depth along the axis.
///   error  < 1e-4: tests/showmysky/eclipse.cpp
class ShadowLight
{
public:
    /// \param reach    points are at most so far from the camera, m
    /// \param law      null: a uniform disc
    /// \param weights  [wavelength], of X, Y, Z and scotopic luminance: colours of a disc that is darker at its limb
    ShadowLight(const sky::physics::Shadow& shadow, double reach, const sky::physics::LimbDarkening* law,
                const std::vector<Texel>& weights);

    /// Share of the light left, in the camera's frame, m. All four are the same for a uniform disc.
    Texel at(const std::array<float, 3>& point) const;
    /// The same with where its light comes from: physics::VisibleSun of an even disc.
    struct Seen {
        Texel share;
        std::array<float, 3> aside;
    };
    Seen seen(const std::array<float, 3>& point) const;
    /// The second of the four, Y.
    float luminance(const std::array<float, 3>& point) const { return at(point)[1]; }

private:
    /// Where a point stands in the table; nothing is hidden outside of the penumbra.
    struct Place {
        const Texel *low, *high; ///< two depths, each followed by its next place; null outside
        float x, y;              ///< between them
        float far;               ///< from the axis, m
    };
    Place placeOf(const std::array<float, 3>& point) const;
    static Texel between(const Place& place);

    static constexpr int depths = 33, places = 513;
    sky::physics::ShadowOf<float> shadow_;
    float nearest_ = 0, perDepth_ = 0;                                    ///< of the depth axis
    float umbra_ = 0, umbraSlope_ = 0, penumbra_ = 0, penumbraSlope_ = 0; ///< radii at the camera's depth, m, and per m
    std::vector<Texel> table_;                                            ///< [depth][place]
    std::vector<float> middles_;                                          ///< [depth][place], rad: physics::middleOfVisible
};

} // namespace showmysky
