#pragma once
// The error of many radiances against a reference that is itself noisy.

#include <algorithm>
#include <cmath>

namespace sky::model {

/// Relative errors e_i with known noise n_i (one standard error of the reference, relative). The noise adds its variance to
/// the squares, on average, so the rms of what is left is sqrt(mean(e^2 - n^2)).
class ErrorSummary
{
public:
    void add(double error, double noise)
    {
        squares_ += error * error;
        noise2_ += noise * noise;
        noise4_ += noise * noise * noise * noise;
        sum_ += error;
        worst_ = std::max(worst_, std::abs(error));
        ++rows_;
    }

    int rows() const { return rows_; }
    /// Noise removed; 0 where the noise explains all of the difference.
    double rms() const { return std::sqrt(std::max(0., meanSquare())); }
    /// How far the noise may have moved rms() upwards or downwards: one standard error of mean(e^2 - n^2), by the variance of
    /// the square of a sum of a fixed error and Gaussian noise, 2 n^4 + 4 e^2 n^2.
    double uncertainty() const
    {
        if (rows_ == 0)
            return 0;
        const double m = std::max(0., meanSquare());
        const double sigma = std::sqrt(2 * noise4_ + 4 * m * noise2_) / rows_;
        return std::sqrt(m + sigma) - std::sqrt(m);
    }
    double mean() const { return rows_ > 0 ? sum_ / rows_ : 0; }
    double noise() const { return rows_ > 0 ? std::sqrt(noise2_ / rows_) : 0; }
    double worst() const { return worst_; } ///< largest |error|, noise included

private:
    double meanSquare() const { return rows_ > 0 ? (squares_ - noise2_) / rows_ : 0; }

    int rows_ = 0;
    double squares_ = 0, noise2_ = 0, noise4_ = 0, sum_ = 0, worst_ = 0;
};

} // namespace sky::model
