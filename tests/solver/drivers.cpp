// Drivers differ in their functions: what is computed must not.
#include "../gl/poor_driver.hpp"
#include "../gl/shader_interceptor.hpp"
#include "support.hpp"
#include <algorithm>

using namespace sky;
using namespace sky::solver;
using namespace sky::solver::test;

namespace {

/// A scene with something of everything: two scatterers, one of them hazy and sharp, an absorber, light pollution.
atmo::Description scene()
{
    SceneText text;
    text.species =
        SceneText::rayleigh() + SceneText::dust() + text.absorber() + "light pollution relative radiance: " + text.all("1") + "\n";
    text.views = "8", text.azimuths = "4", text.suns = "8";
    return text.parse();
}

Options wholeDigits()
{
    Options options = draft();
    options.texturePrecisionBits = 24; // tables as they were computed
    return options;
}

/// Largest relative difference of the values of a table that are above 1e-6 of its largest. Logarithms and ratios, which have signs:
/// absolute, below one.
double difference(const model::Model& model, const model::Model& reference, const model::Table& table)
{
    const auto a = model.readAll(table.name), b = reference.readAll(table.name);
    REQUIRE(a.size() == b.size());
    const float floor = 1e-6F * *std::max_element(b.begin(), b.end());
    double result = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (table.isSigned || b[i] > floor)
            result = std::max(result, std::abs(double(a[i]) - double(b[i])) / std::max(table.isSigned ? 1. : 0., std::abs(double(b[i]))));
    return result;
}

} // namespace

TEST_CASE("drivers: tables depend little on a driver that uses up the errors it may make", "[gl]")
{
    auto good = gl::testing::context();
    if (!good)
        return;
    const Run reference(*good, scene(), wholeDigits());
    for (const char* noise : {"poor_random(x)", "1.0", "-1.0"}) {
        CAPTURE(noise);
        gl::testing::ShaderInterceptor interceptor(gl::testing::poorDriver(noise));
        auto poor = gl::testing::context();
        REQUIRE(poor);
        interceptor.standBefore(*poor);
        const Run run(*poor, scene(), wholeDigits());
        REQUIRE(interceptor.shaders() > 3);
        for (const auto& table : reference.model.tables()) {
            CAPTURE(table.name);
            if (table.name.starts_with("medium"))
                continue; // its altitudes may be others; what follows from it is compared
            // Light through an optical depth of 13 loses exp(-13), which may be wrong by 29 ULP: 3.5e-6; of that a few together.
            CHECK(difference(run.model, reference.model, table) < 5e-5);
        }
    }
}
