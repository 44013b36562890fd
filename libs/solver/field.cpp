#include "solver/field.hpp"
#include "base/parallel.hpp"
#include "physics/harmonics.hpp"
#include <cmath>

namespace sky::solver {

struct FieldTexels::Data {
    int suns;
    double vLowest;
    std::vector<float> moments, ground;
};

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double toLog2 = 1.44269504088896340736;

} // namespace

FieldTexels::FieldTexels(const gl::Api& api, const Data& data)
    : suns(data.suns), vLowest(data.vLowest), moments(api, "field of moments", data.moments),
      ground(api, "field of ground irradiance", data.ground)
{
}

FieldTexels::FieldTexels(const gl::Api& api, const physics::Moments& m, const int refinement)
    : FieldTexels(api, [&] {
          const auto& grid = m.grid;
          const int sets = (m.wavelengths + 3) / 4, harmonics = physics::harmonicCount(m.degree);
          Data data;
          data.suns = (grid.sunCount() - 1) * refinement + 1;
          const double scale = std::sinh(physics::MomentGrid::sinhScale);
          data.vLowest = std::asinh(grid.lowestElevation() / (pi / 2) * scale) / physics::MomentGrid::sinhScale;
          data.moments.assign(std::size_t(grid.altitudeCount()) * data.suns * harmonics * sets * 4, 0.F);
          data.ground.assign(std::size_t(data.suns) * sets * 4, 0.F);
          base::parallel([&](int thread, int threads) {
              for (int a = thread; a < grid.altitudeCount(); a += threads)
                  for (int f = 0; f < data.suns; ++f) {
                      const auto stencil = grid.sunStencil(double(f) / refinement);
                      for (int lm = 0; lm < harmonics; ++lm)
                          for (int w = 0; w < m.wavelengths; ++w) {
                              double value = 0;
                              for (int j = 0; j < 4; ++j)
                                  value += stencil.weight[j] * m.at(a, stencil.index[j])[lm * m.wavelengths + w];
                              data.moments[((std::size_t(a) * data.suns + f) * harmonics + lm) * sets * 4 + w] =
                                  static_cast<float>(lm == 0 ? value * toLog2 : value);
                          }
                  }
          });
          for (int f = 0; f < data.suns; ++f) {
              const auto stencil = grid.sunStencil(double(f) / refinement);
              for (int w = 0; w < m.wavelengths; ++w) {
                  double value = 0;
                  for (int j = 0; j < 4; ++j)
                      value += stencil.weight[j] *
                               std::log2(std::max(m.groundIrradiance[stencil.index[j] * m.wavelengths + w], physics::darkness));
                  data.ground[std::size_t(f) * sets * 4 + w] = static_cast<float>(value);
              }
          }
          return data;
      }())
{
}

} // namespace sky::solver
