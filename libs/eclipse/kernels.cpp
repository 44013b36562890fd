#include "eclipse/kernels.hpp"
#include "physics/harmonics.hpp"
#include <cmath>
#include <cstdlib>

#if defined(__GNUC__)
#define SKY_INLINE inline __attribute__((always_inline))
#else
#define SKY_INLINE inline
#endif

namespace sky::eclipse {

namespace {

using physics::harmonicIndex;
constexpr int cosineIndex(int l, int m) { return l * l + std::max(0, 2 * m - 1); }
constexpr int sineIndex(int l, int m) { return l * l + 2 * m; }

template<int degree>
SKY_INLINE void radiateDegree(const float* cosines, const float* sines, int azimuths, const Seen& seen, int points, Lane* planes)
{
    const int count = static_cast<int>(seen.levels.size()), harmonics = allHarmonics(seen.degree);
    for (int p = 0; p < points; ++p) {
        Lane even[degree + 1], odd[degree + 1]; // factors of cos(m phi), sin(m phi)
        for (int m = 0; m <= degree; ++m)
            even[m] = odd[m] = Lane{};
        for (int e = 0; e < count; ++e) {
            const Lane *here = seen.levels[static_cast<std::size_t>(e)] + p * harmonics, *factors = seen.coefficients + e * seen.terms;
            // Unrolled, so that the sums stay in registers.
#pragma GCC unroll 8
            for (int l = 0; l <= degree; ++l)
#pragma GCC unroll 8
                for (int m = 0; m <= l; ++m) {
                    const Lane c = factors[harmonicIndex(l, m)];
                    even[m] += c * here[cosineIndex(l, m)];
                    if (m > 0)
                        odd[m] += c * here[sineIndex(l, m)];
                }
        }
        for (int q = 0; q < azimuths / 4; ++q) {
            const float *cosine = cosines + q * (degree + 1), *sine = sines + q * (degree + 1);
            Lane c[2] = {even[0], Lane{}}, s[2] = {Lane{}, Lane{}}; // even and odd m
            for (int m = 1; m <= degree; ++m) {
                c[m % 2] += cosine[m] * even[m];
                s[m % 2] += sine[m] * odd[m];
            }
            Lane* out = planes + p;
            out[q * points] = c[0] + c[1] + s[0] + s[1];
            out[(azimuths / 2 - 1 - q) * points] = c[0] - c[1] - s[0] + s[1];
            out[(azimuths / 2 + q) * points] = c[0] - c[1] + s[0] - s[1];
            out[(azimuths - 1 - q) * points] = c[0] + c[1] - s[0] - s[1];
        }
    }
}

template<int degree>
SKY_INLINE void projectDegree(const float* cosines, const float* sines, int azimuths, const Lane* planes, const float* factors,
                              float solidAngle, int points, Lane* moments, Lane* rings, float cosine)
{
    for (int p = 0; p < points; ++p) {
        Lane even[degree + 1], odd[degree + 1];
        for (int m = 0; m <= degree; ++m)
            even[m] = odd[m] = Lane{};
        for (int q = 0; q < azimuths / 4; ++q) {
            const Lane* in = planes + p;
            const Lane a = in[q * points], b = in[(azimuths / 2 - 1 - q) * points];
            const Lane c = in[(azimuths / 2 + q) * points], d = in[(azimuths - 1 - q) * points];
            const Lane cosines2[2] = {a + b + c + d, a - b - c + d}, sines2[2] = {a - b + c - d, a + b - c - d};
            even[0] += cosines2[0];
            for (int m = 1; m <= degree; ++m) {
                even[m] += cosines[q * (degree + 1) + m] * cosines2[m % 2];
                odd[m] += sines[q * (degree + 1) + m] * sines2[m % 2];
            }
        }
        Lane* out = moments + p * allHarmonics(degree);
        for (int l = 0; l <= degree; ++l)
            for (int m = 0; m <= l; ++m) {
                const float y = solidAngle * factors[harmonicIndex(l, m)];
                out[cosineIndex(l, m)] += y * even[m];
                if (m > 0)
                    out[sineIndex(l, m)] += y * odd[m];
            }
        if (rings)
            rings[p] += (solidAngle * cosine) * even[0];
    }
}

} // namespace

SKY_WIDEST_VECTORS
void radiate(const Turn& turn, const Seen& seen, int points, Lane* planes)
{
    const float *c = turn.cosines.data(), *s = turn.sines.data();
    switch (turn.degree) {
    case 0: return radiateDegree<0>(c, s, turn.count, seen, points, planes);
    case 1: return radiateDegree<1>(c, s, turn.count, seen, points, planes);
    case 2: return radiateDegree<2>(c, s, turn.count, seen, points, planes);
    case 3: return radiateDegree<3>(c, s, turn.count, seen, points, planes);
    case 4: return radiateDegree<4>(c, s, turn.count, seen, points, planes);
    case 5: return radiateDegree<5>(c, s, turn.count, seen, points, planes);
    default: return radiateDegree<mostDegree>(c, s, turn.count, seen, points, planes);
    }
}

SKY_WIDEST_VECTORS
void project(const Turn& turn, const Lane* planes, const float* factors, float weight, int points, Lane* moments, Lane* rings, float cosine)
{
    const float *c = turn.cosines.data(), *s = turn.sines.data();
    const float solidAngle = weight / static_cast<float>(turn.count);
    switch (turn.degree) {
    case 0: return projectDegree<0>(c, s, turn.count, planes, factors, solidAngle, points, moments, rings, cosine);
    case 1: return projectDegree<1>(c, s, turn.count, planes, factors, solidAngle, points, moments, rings, cosine);
    case 2: return projectDegree<2>(c, s, turn.count, planes, factors, solidAngle, points, moments, rings, cosine);
    case 3: return projectDegree<3>(c, s, turn.count, planes, factors, solidAngle, points, moments, rings, cosine);
    case 4: return projectDegree<4>(c, s, turn.count, planes, factors, solidAngle, points, moments, rings, cosine);
    case 5: return projectDegree<5>(c, s, turn.count, planes, factors, solidAngle, points, moments, rings, cosine);
    default: return projectDegree<mostDegree>(c, s, turn.count, planes, factors, solidAngle, points, moments, rings, cosine);
    }
}

Shifts::Shifts(const Grid& from, const Grid& to, const Turn& turn, const float distance)
    : azimuths_(turn.count), columns_(to.x.count()), rows_(to.y.count())
{
    const auto half = static_cast<std::size_t>(azimuths_ / 2);
    along_.reserve(half * static_cast<std::size_t>(columns_));
    across_.reserve(half * static_cast<std::size_t>(rows_));
    for (int i = 0; i < azimuths_ / 2; ++i) {
        const float x = distance * static_cast<float>(std::cos(turn.azimuth(i)));
        for (const float point : to.x.points())
            along_.push_back(from.x.at(point + x));
    }
    for (const int side : {1, -1})
        for (int q = 0; q < azimuths_ / 4; ++q) {
            const float y = static_cast<float>(side) * distance * static_cast<float>(std::sin(turn.azimuth(q)));
            for (const float point : to.y.points())
                across_.push_back(from.y.at(point + y));
        }
}

const Neighbours* Shifts::across(const int azimuth) const
{
    // The sines of t, pi - t; of pi + t, -t.
    const int half = azimuths_ / 2, inHalf = azimuth % half, q = std::min(inHalf, half - 1 - inHalf);
    return &across_[static_cast<std::size_t>((azimuth / half * (half / 2) + q) * rows_)];
}

SKY_WIDEST_VECTORS
void addShifted(const Shifts& shifts, int azimuth, int sourceAlong, const Lane* plane, const Lane* mirror, Lane* row, Lane* sums)
{
    const Neighbours *across = shifts.across(azimuth), *along = shifts.along(azimuth);
    const int columns = shifts.columns(), rows = shifts.rows();
    const int first = along[0].index[0], last = along[columns - 1].index[3];
    for (int j = 0; j < rows; ++j) {
        const Neighbours& n = across[j];
        const Lane *own = n.mirrored ? mirror : plane, *other = n.mirrored ? plane : mirror;
        const Lane* line[4];
        for (int k = 0; k < 4; ++k)
            line[k] = n.index[k] < 0 ? other - n.index[k] * sourceAlong : own + n.index[k] * sourceAlong;
        const float w0 = n.weight[0], w1 = n.weight[1], w2 = n.weight[2], w3 = n.weight[3];
        for (int i = first; i <= last; ++i)
            row[i] = w0 * line[0][i] + w1 * line[1][i] + w2 * line[2][i] + w3 * line[3][i];
        Lane* out = sums + j * columns;
        for (int i = 0; i < columns; ++i) {
            const Neighbours& m = along[i];
            out[i] += m.weight[0] * row[m.index[0]] + m.weight[1] * row[m.index[1]] + m.weight[2] * row[m.index[2]] +
                      m.weight[3] * row[m.index[3]];
        }
    }
}

SKY_WIDEST_VECTORS
void addShiftedToAll(const Shifts& shifts, const Grid& source, const Lane* plane, Lane* moved, Lane* sums, int stride)
{
    const int azimuths = shifts.azimuths(), columns = shifts.columns(), rows = shifts.rows(), sourceAlong = source.x.count();
    for (int a = 0; a < azimuths / 2; ++a) { // which shares its shift along with azimuth -a
        const Neighbours* along = shifts.along(a);
        for (int j = 0; j < source.y.count(); ++j) {
            const Lane* row = plane + j * sourceAlong;
            for (int i = 0; i < columns; ++i) {
                const Neighbours& m = along[i];
                moved[j * columns + i] = m.weight[0] * row[m.index[0]] + m.weight[1] * row[m.index[1]] + m.weight[2] * row[m.index[2]] +
                                         m.weight[3] * row[m.index[3]];
            }
        }
        for (const int azimuth : {a, azimuths - 1 - a}) {
            const Neighbours* across = shifts.across(azimuth);
            for (int j = 0; j < rows; ++j) {
                const Neighbours& n = across[j];
                const float w0 = n.weight[0], w1 = n.weight[1], w2 = n.weight[2], w3 = n.weight[3];
                const Lane* line[4];
                for (int k = 0; k < 4; ++k)
                    line[k] = moved + std::abs(n.index[k]) * columns;
                Lane* out = sums + azimuth * stride + j * columns;
                for (int i = 0; i < columns; ++i)
                    out[i] += w0 * line[0][i] + w1 * line[1][i] + w2 * line[2][i] + w3 * line[3][i];
            }
        }
    }
}

SKY_WIDEST_VECTORS
void foldPoint(int degree, const Lane* lower, const Lane* upper, float share, const Lane* coefficients, Lane* terms)
{
    for (int k = 0; k <= 2 * degree; ++k)
        terms[k] = Lane{};
    for (int l = 0; l <= degree; ++l)
        for (int m = 0; m <= l; ++m) {
            const int i = cosineIndex(l, m), k = sineIndex(l, m);
            const Lane c = coefficients[harmonicIndex(l, m)];
            terms[m] += c * (lower[i] + share * (upper[i] - lower[i]));
            if (m > 0)
                terms[degree + m] += c * (lower[k] + share * (upper[k] - lower[k]));
        }
}

SKY_WIDEST_VECTORS
void addFolded(int degree, int count, const Lane* const* terms, const float* weights, const bool* mirrored, const float* cosines,
               const float* sines, Lane& sum)
{
    Lane value{};
    for (int m = 0; m <= degree; ++m) {
        Lane even{}, odd{}; // about the mirror plane
        for (int c = 0; c < count; ++c) {
            even += weights[c] * terms[c][m];
            if (m > 0)
                odd += (mirrored[c] ? -weights[c] : weights[c]) * terms[c][degree + m];
        }
        value += cosines[m] * even + sines[m] * odd;
    }
    sum += value;
}

SKY_WIDEST_VECTORS
bool mix(const Lane* const* levels, int count, const Lane* weights, int stride, int points, Lane* plane)
{
    Lane largest{};
    for (int e = 0; e < count; ++e)
        largest += weights[e * stride];
    float sum = 0;
    for (int i = 0; i < lanes; ++i)
        sum += largest[i];
    if (!(sum > 0))
        return false;
    for (int p = 0; p < points; ++p) {
        Lane value{};
        for (int e = 0; e < count; ++e)
            value += weights[e * stride] * levels[e][p];
        plane[p] = value;
    }
    return true;
}

SKY_WIDEST_VECTORS
void scatterSunlight(int degree, int scatterers, const Lane* phase, const float* nu, const Lane* light, int points, Lane* plane)
{
    for (int p = 0; p < points; ++p) {
        float legendre[mostDegree + 1] = {1, nu[p]};
        for (int l = 1; l < degree; ++l)
            legendre[l + 1] =
                (static_cast<float>(2 * l + 1) * nu[p] * legendre[l] - static_cast<float>(l) * legendre[l - 1]) / static_cast<float>(l + 1);
        Lane sum{};
        for (int s = 0; s < scatterers; ++s) {
            Lane value{};
            for (int l = 0; l <= degree; ++l)
                value += legendre[l] * phase[s * (degree + 1) + l];
            sum += value * light[s * points + p];
        }
        plane[p] = sum;
    }
}

} // namespace sky::eclipse
