#pragma once
#include "solver/bake.hpp"

namespace sky::solver {

/// Intermediate quantities, for developers, as the options ask:
///   --save-scat-density              "scattering-density/order-N": moments of the emission coefficient that makes order N
///   --save-scat-density2-from-ground "scattering-density/order-2-from-ground": its part from light that left the ground
///   --save-delta-scattering          "delta-scattering/order-N": the 4D table of order N alone
///   --save-accum-scattering          "accumulated-scattering/order-N": the 4D table of orders 2 to N
void writeDebugTables(const gl::Api& api, const BakeJob& job, const RadiationField& field, model::ModelWriter& writer,
                      const std::function<void(double)>& breath);

} // namespace sky::solver
