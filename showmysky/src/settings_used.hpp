#pragma once
// Layers with names resolved: what the gathers obey.

#include <vector>

namespace showmysky {

struct LayersUsed {
    bool ground = true;
    bool groundDirect = true, groundDiffuse = true; ///< parts of its light, where it is shown
    bool multiple = true;
    std::vector<bool> single; ///< [scatterer]
};

} // namespace showmysky
