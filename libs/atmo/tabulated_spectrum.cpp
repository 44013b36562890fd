#include "atmo/tabulated_spectrum.hpp"

#include "atmo/value.hpp"

#include <algorithm>
#include <cmath>

namespace sky::atmo {

namespace {

constexpr double longestNm = 1e9; // one metre: enough for any light, and differences stay finite

} // namespace

TabulatedSpectrum::TabulatedSpectrum(const Source& table)
{
    std::size_t descending = 0;
    for (int number = 1; number <= table.lineCount(); ++number) {
        const std::string_view line = table.line(number);
        const std::string_view content = line.substr(0, line.find('#'));
        ValueReader reader(table, {number, 0}, content);
        if (reader.atEnd())
            continue;
        const Position place = reader.place();
        const double nm = reader.number();
        reader.expect(',', "the wavelength");
        const double value = reader.number();
        if (!(nm > 0 && nm <= longestNm))
            table.fail(place, "the wavelength must be above 0 and at most 1e9 nm");
        if (!reader.atEnd())
            reader.fail("expected two columns, wavelength in nm and value");
        if (!wavelengthsNm_.empty()) {
            descending += nm < wavelengthsNm_.back();
            // All steps must go the way of the first one.
            if (nm == wavelengthsNm_.back() || (descending != 0 && descending != wavelengthsNm_.size()))
                table.fail(place, "the wavelengths are out of order; expected each of them once, rising or falling");
        }
        wavelengthsNm_.push_back(nm);
        values_.push_back(value);
    }
    if (wavelengthsNm_.empty())
        table.fail({1, 0}, "the table has no points; expected lines like `400,0.2342`: wavelength in nm, value");
    if (descending > 0) {
        std::reverse(wavelengthsNm_.begin(), wavelengthsNm_.end());
        std::reverse(values_.begin(), values_.end());
    }
}

double TabulatedSpectrum::at(double nm) const
{
    if (nm <= firstNm())
        return values_.front();
    if (nm >= lastNm())
        return values_.back();
    const auto above = std::upper_bound(wavelengthsNm_.begin(), wavelengthsNm_.end(), nm);
    const auto i = static_cast<std::size_t>(above - wavelengthsNm_.begin());
    const double fraction = (nm - wavelengthsNm_[i - 1]) / (wavelengthsNm_[i] - wavelengthsNm_[i - 1]);
    return std::lerp(values_[i - 1], values_[i], fraction);
}

double TabulatedSpectrum::bandMean(double nm, double halfWidthNm) const
{
    const double from = std::max(nm - halfWidthNm, firstNm()), to = std::min(nm + halfWidthNm, lastNm());
    if (!(to > from))
        return at(nm);
    // The trapezium rule over the points inside is exact for a piecewise-linear function.
    double integral = 0, previousNm = from, previousValue = at(from);
    const auto step = [&](double nextNm, double nextValue) {
        integral += 0.5 * (nextNm - previousNm) * (previousValue + nextValue);
        previousNm = nextNm;
        previousValue = nextValue;
    };
    const auto inside = std::upper_bound(wavelengthsNm_.begin(), wavelengthsNm_.end(), from);
    for (auto i = static_cast<std::size_t>(inside - wavelengthsNm_.begin()); wavelengthsNm_[i] < to; ++i)
        step(wavelengthsNm_[i], values_[i]);
    step(to, at(to));
    return integral / (to - from);
}

} // namespace sky::atmo
