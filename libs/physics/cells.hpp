#pragma once
#include <algorithm>
#include <cmath>

namespace sky::physics {

/// How a stretch of a ray is divided into cells: evenly; or, where it is too thick for even cells to resolve the first optical depths,
/// as a sinh from its near end, so that the first cell is as deep as wanted and each of the others some part larger than the last.
/// (Even cells of a cloud with optical depth 1e5 along the ray would put all its light into a fraction of the first.)
class CellDivision
{
public:
    /// \param depth      optical depth of the stretch
    /// \param cellDepth  wanted of the first cell
    CellDivision(double from, double to, int count, double depth, double cellDepth)
        : from_(from), length_(to - from), count_(count)
    {
        const double excess = std::min(depth / (count * cellDepth), 1e12); // sinh(a) / a
        if (!(excess > 1))
            return;
        stretch_ = std::min(std::sqrt(6 * (excess - 1)), std::log(2 * excess) + 1);
        for (int i = 0; i < 3; ++i)
            stretch_ = std::asinh(excess * stretch_);
        scale_ = 1 / std::sinh(stretch_);
    }
    /// Distance at the far end of cell `index`, 1..count.
    double end(int index) const
    {
        const double x = static_cast<double>(index) / count_;
        return from_ + length_ * (stretch_ > 0 ? scale_ * std::sinh(stretch_ * x) : x);
    }

    /// Length of the last cell in lengths of an even one, about; 0 or less than 1 where all are even or nearly so.
    double growth() const { return stretch_; }

private:
    double from_, length_;
    int count_;
    double stretch_ = 0, scale_ = 0;
};

} // namespace sky::physics
