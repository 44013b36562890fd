#pragma once
// The textures source: the sky of one altitude and Sun from the baked 4D tables.

#include "atmosphere.hpp"
#include "model/scattering_table.hpp"
#include "phases.hpp"
#include "settings_used.hpp"
#include "sky_view.hpp"
#include <map>

namespace showmysky {

class TextureLookup
{
public:
    TextureLookup(const Atmosphere& atmosphere, const Phases& phases) : atmosphere_(atmosphere), phases_(phases) {}

    /// Empty if the model holds the tables of all scatterers and of multiple scattering; otherwise the name of one that
    /// is missing.
    static std::string missingTable(const Atmosphere& atmosphere);
    /// True if some table holds luminance, on which another solar spectrum can't act.
    static bool anyLuminance(const Atmosphere& atmosphere);

    /// Scattered light alone: no ground. Tables are opened when a layer first needs them.
    ///   weights  X, Y, Z, scotopic of unit radiance per unit solar irradiance, [wavelength]
    SkyView slice(double altitude, double muSun, const LayersUsed& layers, const std::vector<Texel>& weights);
    /// Light of higher orders while the Moon stands before the Sun (sky::model::eclipseTable), which the model must have.
    ViewTable eclipsed(double altitude, double muSun, const std::vector<Texel>& weights);

private:
    ViewTable look(const std::string& name, int scatterer, double altitude, double muSun, const std::vector<Texel>& weights);
    const sky::model::ScatteringTable& table(const std::string& name);

    const Atmosphere& atmosphere_;
    const Phases& phases_;
    std::map<std::string, sky::model::ScatteringTable> tables_;
};

} // namespace showmysky
