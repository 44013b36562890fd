#pragma once
// Radiance from the baked 4D tables of a model, interpolated on the CPU.

#include "model/model.hpp"
#include "physics/table_axes.hpp"
#include <map>
#include <string>
#include <vector>

namespace sky::model {

/// One 4D table: [altitude][Sun][view][relative azimuth], "multiple-scattering" for instance.
///
/// How it is interpolated: Catmull-Rom over the node index on every axis; of logarithms on the axes altitude, Sun and view (radiance
/// spans decades along them, and is never negative), of values in azimuth. Altitude and Sun first: they change rarely. Where a
/// neighbour is zero, linearly. Not thread-safe: it keeps the layers it has read.
class ScatteringTable
{
public:
    /// throws ModelError if there is no such table or it isn't a 4D table
    ScatteringTable(const Model& model, const std::string& name);

    int channels() const { return channels_; }
    int views() const { return views_; } ///< even: half below the horizon, half above
    int azimuths() const { return azimuths_; }
    const Table& table() const { return table_; }

    /// The sky of one altitude (m, 0 .. top) and Sun (rad, centre of the disc; outside the axis: darkness below it).
    ///   returns [view][azimuth][channel], in the table's unit; views as physics::viewMuNodes
    ///   throws  ModelError
    std::vector<float> slice(double altitude, double sunElevation) const;

    /// One direction of a slice.
    ///   viewElevation   rad; what lies below the geometric horizon of the altitude looks at the ground
    ///   relativeAzimuth rad, any
    ///   result          [channel]
    void sample(const std::vector<float>& slice, double altitude, double viewElevation, double relativeAzimuth, double* result) const;

private:
    const std::vector<float>& layer(int index) const;

    const Model& model_;
    Table table_;
    int channels_, views_, azimuths_, suns_, layers_;
    physics::SunTableAxis sunAxis_;
    mutable std::map<int, std::vector<float>> read_;
};

} // namespace sky::model
