// Every function of shaders/lib on the GPU against its twin in double precision, over tables of inputs with their hard points.
#include "../gl/context_for_tests.hpp"
#include "base/angles.hpp"
#include "gl/buffer.hpp"
#include "gl/program.hpp"
#include "physics/moments.hpp"
#include "physics/quadrature.hpp"
#include "physics/shadow_edge.hpp"
#include "physics/sun.hpp"
#include "sky_shaders.hpp"
#include <cmath>

using namespace sky;

namespace {

using Vec4 = std::array<float, 4>;
using sky::base::pi;

/// The values of a GLSL expression of `vec4 x`, with a file of shaders/lib included.
std::vector<float> evaluate(const gl::Api& api, const std::string& include, const std::string& expression, const std::vector<Vec4>& inputs)
{
    const std::string text = "layout(local_size_x = 64) in;\n"
                             "layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };\n"
                             "layout(std430, binding = 1) writeonly buffer Results { float results[]; };\n"
                             "uniform int count;\n"
                             "#include \"" +
                             include +
                             "\"\n"
                             "void main() {\n"
                             "    int i = int(gl_GlobalInvocationID.x);\n"
                             "    if (i >= count) return;\n"
                             "    vec4 x = inputs[i];\n"
                             "    results[i] = " +
                             expression +
                             ";\n"
                             "}\n";
    const auto source = [&](std::string_view path) { return path == "test.comp" ? std::string_view(text) : shaders::source(path); };
    gl::Program program = gl::ProgramBuilder(api, source).compute("shader function", "test.comp");
    const gl::Buffer in(api, "inputs", inputs), out(api, "results", inputs.size() * sizeof(float));
    in.bindStorage(0);
    out.bindStorage(1);
    program.set("count", static_cast<int>(inputs.size()));
    program.dispatchOver(static_cast<unsigned>(inputs.size()));
    gl::memoryBarrier(api);
    gl::checkErrors(api, "shader function");
    return out.download();
}

/// -1..1, dense at the ends, at zero and at the seam of the polynomial.
std::vector<float> cosines()
{
    std::vector<float> all;
    for (const float x : {0.F, 1e-30F, 1e-6F, 1e-3F, 0.1F, 0.4999999F, 0.5F, 0.5000001F, 0.7F, 0.99F, 0.9999F, 0.9999999F, 1.F})
        for (const float sign : {-1.F, 1.F})
            all.push_back(sign * x);
    for (int i = -50; i <= 50; ++i)
        all.push_back(static_cast<float>(i) / 50.F);
    return all;
}

} // namespace

TEST_CASE("shader: elevation from its sine", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<Vec4> inputs;
    for (const float mu : cosines())
        inputs.push_back({mu, 0, 0, 0});
    inputs.push_back({1.0000001F, 0, 0, 0}); // a rounded cosine
    const auto values = evaluate(context->api(), "lib/angles.glsl", "elevationOf(x.x)", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        INFO("mu " << inputs[i][0]);
        const double truth = std::asin(std::min(1., double(inputs[i][0])));
        CHECK(double(values[i]) == Approx(truth).epsilon(3e-7).margin(1e-37)); // as the function promises; 3 roundings
    }
}

TEST_CASE("shader: cosine and sine", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<Vec4> inputs;
    for (int i = -800; i <= 800; ++i)
        inputs.push_back({static_cast<float>(i * pi / 100), 0, 0, 0}); // four turns, and all multiples of an eighth
    for (const float x : {1e-30F, 1e-4F, 0.785398F, 0.7853982F, 99.F})
        for (const float sign : {-1.F, 1.F})
            inputs.push_back({sign * x, 0, 0, 0});
    const auto cosines = evaluate(context->api(), "lib/angles.glsl", "cosineAndSine(x.x).x", inputs);
    const auto sines = evaluate(context->api(), "lib/angles.glsl", "sine(x.x)", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        INFO("x " << inputs[i][0]);
        CHECK(double(cosines[i]) == Approx(std::cos(double(inputs[i][0]))).epsilon(0).margin(2e-7));
        CHECK(double(sines[i]) == Approx(std::sin(double(inputs[i][0]))).epsilon(0).margin(2e-7));
    }
}

TEST_CASE("shader: inverse hyperbolic sine", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<Vec4> inputs;
    for (const float x : {0.F, 1e-4F, 0.01F, 0.3F, 1.F, 7.F, 60.F, 1e4F})
        for (const float sign : {-1.F, 1.F})
            inputs.push_back({sign * x, 0, 0, 0});
    const auto values = evaluate(context->api(), "lib/angles.glsl", "inverseSinh(x.x)", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        CHECK(double(values[i]) == Approx(std::asinh(double(inputs[i][0]))).epsilon(1e-5).margin(2e-7)); // a + 1 drops digits of small a
}

TEST_CASE("shader: visible part of the disc", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<Vec4> inputs;
    for (const float radius : {0.00465F, 0.1F})
        for (const float x : cosines())
            for (const float beyond : {1.F, 1.1F})
                inputs.push_back({beyond * x * radius, radius, 0, 0});
    inputs.push_back({-1e-20F, 0, 0, 0}); // a Sun without extent
    inputs.push_back({1e-20F, 0, 0, 0});
    inputs.push_back({0, 0, 0, 0});
    const auto values = evaluate(context->api(), "lib/sun.glsl", "visibleDiscFraction(x.x, x.y)", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        INFO("above " << inputs[i][0] << " radius " << inputs[i][1]);
        // The sum 1/2 + ... is rounded at one half.
        CHECK(double(values[i]) == Approx(physics::visibleDiscFraction(double(inputs[i][0]), double(inputs[i][1]))).margin(4e-7));
    }
}

TEST_CASE("shader: part of the disc that shows to a node and its neighbours", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<Vec4> inputs;
    for (const float radius : {0.F, 0.00465F})
        for (const float before : {-0.01F, 0.F, 0.003F})
            for (const float after : {-0.002F, 0.F, 0.02F})
                for (const float here : {-0.02F, -0.004F, 0.F, 0.001F})
                    inputs.push_back({here + before, here, here + after, radius});
    const auto values = evaluate(context->api(), "lib/sun.glsl", "visibleAlong(x.x, x.y, x.z, x.w)", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        INFO("before " << inputs[i][0] << " here " << inputs[i][1] << " after " << inputs[i][2] << " radius " << inputs[i][3]);
        const double expected =
            physics::visibleAlong(double(inputs[i][0]), double(inputs[i][1]), double(inputs[i][2]), double(inputs[i][3]));
        CHECK(double(values[i]) == Approx(expected).margin(2e-6)); // differences of elevations are rounded
    }
}

TEST_CASE("shader: axes of the tables over the Sun's elevation", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const std::vector<double> elevations{-1.5, -0.46, -0.45, -0.1, -0.0046, -1e-5, 0., 1e-4, 0.0046, 0.02, 0.3, 1., pi / 2};
    for (const double scale : {3., 7.5}) {
        const physics::MomentGrid grid({6.371e6, 120e3}, {0, 120e3}, -0.45, 33, scale);
        std::vector<Vec4> moments;
        for (const double e : elevations)
            moments.push_back({static_cast<float>(e), static_cast<float>(scale), static_cast<float>(std::sinh(scale)),
                               static_cast<float>(grid.vLowest())});
        const auto values = evaluate(context->api(), "lib/sun.glsl", "momentAxis(x.x, x.yzw)", moments);
        for (std::size_t i = 0; i < moments.size(); ++i) {
            INFO("elevation " << moments[i][0] << " scale " << scale);
            CHECK(double(values[i]) ==
                  Approx(grid.sunPosition(double(moments[i][0])) / 32).margin(1e-6)); // a hundredth of a texel of 32 would be 3e-4
        }
    }
    for (const double scale : {0.03, 3e-6}) {
        std::vector<Vec4> sun;
        for (const double e : elevations)
            for (const double horizon : {0., -0.0018, -0.19})
                for (const double radius : {0., 0.0046})
                    sun.push_back({static_cast<float>(e - horizon), static_cast<float>(horizon), static_cast<float>(radius),
                                   static_cast<float>(1 / std::asinh((pi / 2 - horizon + radius) / scale))});
        const auto values = evaluate(context->api(), "lib/sun.glsl", "sunAxis(x.x, x.z, " + std::to_string(scale) + ", x.w)", sun);
        for (std::size_t i = 0; i < sun.size(); ++i) {
            const double x = std::max(0., double(sun[i][0]) + double(sun[i][2]));
            INFO("above " << sun[i][0] << " horizon " << sun[i][1] << " scale " << scale);
            CHECK(double(values[i]) == Approx(std::min(1., std::asinh(x / scale) * double(sun[i][3]))).margin(1e-6));
        }
    }
}

TEST_CASE("shader: mean cosine of the visible disc on level ground", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const double radius = 0.00465;
    std::vector<Vec4> inputs;
    for (const double x : {-2., -1., -0.995, -0.9, -0.5, 0., 0.5, 0.9, 1., 1.001, 20., 150.})
        inputs.push_back({static_cast<float>(std::sin(x * radius)), static_cast<float>(x * radius), static_cast<float>(radius), 0});
    const auto values = evaluate(context->api(), "lib/sun.glsl", "horizontalSunCosine(x.x, x.y, x.z)", inputs);
    const auto strips = physics::gaussLegendre(60);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        // Centroid of the segment above the horizon, by quadrature over the angle t of the strip y = radius cos t.
        const double e = double(inputs[i][1]), lowest = std::acos(std::min(1., std::max(-1., -e / radius)));
        double area = 0, height = 0;
        for (int q = 0; q < 60; ++q) {
            const double t = 0.5 * lowest * (1 + strips.nodes[q]), weight = strips.weights[q] * std::sin(t) * std::sin(t);
            area += weight;
            height += weight * std::sin(e + radius * std::cos(t));
        }
        INFO("elevation in radii " << e / radius);
        // Less than a hundredth of the disc is taken for none; elsewhere to first order in the radius.
        CHECK(double(values[i]) == Approx(area > 0 ? height / area : 0).epsilon(1e-4).margin(0.006 * radius));
    }
}

TEST_CASE("shader: azimuth from three cosines", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<Vec4> inputs;
    std::vector<double> truth;
    for (const double mu : {-0.99, -0.5, 0., 0.3, 0.95})
        for (const double muSun : {-0.1, 0., 0.7, 0.99})
            for (const double phi : {0., 1e-3, 0.7, 2.2, pi}) {
                inputs.push_back({static_cast<float>(mu), static_cast<float>(muSun),
                                  static_cast<float>(mu * muSun + std::sqrt((1 - mu * mu) * (1 - muSun * muSun)) * std::cos(phi)), 0});
                truth.push_back(std::cos(phi));
            }
    for (const float end : {-1.F, 1.F}) { // zenith and nadir: the azimuth is anything, but a number
        inputs.push_back({end, 0.3F, 0.3F * end, 0});
        inputs.push_back({0.3F, end, 0.3F * end, 0});
        truth.insert(truth.end(), 2, 1.);
    }
    const auto values = evaluate(context->api(), "lib/scattered.glsl", "azimuthCosine(x.x, x.y, x.z)", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        INFO("mu " << inputs[i][0] << " muSun " << inputs[i][1]);
        CHECK(double(values[i]) == Approx(truth[i]).margin(2e-5)); // one rounding over the product of the sines, >= 0.02
        CHECK(std::abs(values[i]) <= 1.F);
    }
}

TEST_CASE("shader: whatever a float holds, functions of the library answer with finite numbers", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const std::vector<float> extremes{0,    -0.F,  1e-45F, -1e-45F, 1e-38F, -1e-38F, 1e-6F, -1e-6F,
                                      0.5F, -0.5F, 1,      -1,      1e4F,   -1e4F,   3e18F, -3e18F};
    const std::vector<float> lengths{0, 1e-45F, 1e-38F, 1e-3F, 1, 1e4F, 3e8F}; // m, as long as a way through any air; radii of discs too
    const std::vector<float> ways{1, 300, 1e4F, 3e8F};
    const auto pairs = [](const std::vector<float>& a, const std::vector<float>& b) {
        std::vector<Vec4> inputs;
        for (const float x : a)
            for (const float y : b)
                inputs.push_back({x, y, 0.00465F, 3});
        return inputs;
    };
    struct Function {
        const char *file, *expression;
        std::vector<Vec4> inputs;
        double least, most; ///< of what it may answer
    };
    const double any = 3.5e38, turn = 3.1415928; // rounded up
    const std::vector<Function> functions{
        {"angles", "elevationOf(x.x)", pairs(extremes, {0}), -turn / 2, turn / 2},
        {"angles", "inverseSinh(x.x)", pairs(extremes, {0}), -45, 45},
        {"angles", "sine(clamp(x.x, -100.0, 100.0))", pairs(extremes, {0}), -1.0000002, 1.0000002},
        {"sun", "visibleDiscFraction(x.x, x.y)", pairs(extremes, lengths), 0, 1},
        {"sun", "visibleAlong(x.x, x.y, -x.x, x.z)", pairs(extremes, lengths), 0, 1},
        {"sun", "sunAxis(x.x, x.z, 1e-3, 0.1)", pairs(extremes, {0}), 0, 1},
        {"sun", "momentAxis(x.x, vec3(5.0, 74.2, 0.3))", pairs(extremes, {0}), 0, 1},
        {"sun", "horizontalSunCosine(clamp(x.x, -1.0, 1.0), x.y * x.x, x.z)",
         pairs({0, 1, -1, 1e-3F, -4.65e-3F, 4.65e-3F, -4.6499e-3F}, {1, 0.999999F}), 0, 1},
        {"scattered", "azimuthCosine(clamp(x.x, -1.0, 1.0), clamp(x.y, -1.0, 1.0), clamp(x.x * x.y, -1.0, 1.0))", pairs(extremes, extremes),
         -1, 1},
        {"geometry", "spanInAir(Planet(6.4e6, 1.2e5), x.x, clamp(x.y, -1.0, 1.0), false).end", pairs(lengths, extremes), 0, any},
        {"geometry", // down to the ground from the horizon on; to any other ray no ground is promised
         "spanInAir(Planet(6.4e6, 1.2e5), x.x, -mix(sqrt(x.x * (x.x + 1.28e7)) / (x.x + 6.4e6), 1.0, clamp(abs(x.y), 0.0, 1.0)), true).end",
         pairs(lengths, extremes), 0, 4e8},
        {"aerial", "aerialCoordinate(min(x.x, x.y), x.y, aerialFromCamera)", pairs(ways, ways), 0, 1.000001},
        {"aerial", "aerialCoordinate(min(x.x, x.y), x.y, aerialBothEnds)", pairs(ways, ways), -1e-6, 1.005}, // 300 m beside 3e8
        {"aerial", "aerialDistance(clamp(x.x, 0.0, 1.0), x.y, aerialFromCamera)", pairs(extremes, lengths), 0, 3.003e8},
        {"aerial", "aerialDistance(clamp(x.x, 0.0, 1.0), x.y, aerialBothEnds)", pairs(extremes, lengths), -1e-3, 3.003e8},
        {"aerial", "aerialPlace(x.x, x.y, aerialBothEnds, 24.0)", pairs(lengths, lengths), 0, 23},
        {"display", "toneMapped(vec3(abs(x.x)), abs(x.x), curveExponential).x", pairs(extremes, {0}), 0, 1},
        {"display", "toneMapped(vec3(abs(x.x)), abs(x.x), curveReinhard).x", pairs(extremes, {0}), 0, 1},
        {"display", "encodeSrgb(vec3(clamp(x.x, 0.0, 1.0))).x", pairs(extremes, {0}), 0, 1.000001},
        {"display", "shownColour(vec4(abs(x.x), abs(x.y), abs(x.x), 0.0), modeSrgb, curveExponential, true).y", pairs(extremes, extremes),
         0, 1},
        {"display", "shownColour(vec4(abs(x.x), abs(x.y), abs(x.x), 0.0), modeSrgbBright, curveExponential, true).x",
         pairs(extremes, extremes), 0, 1},
        {"display", "shownColour(vec4(abs(x.x), abs(x.y), abs(x.x), 0.0), modeHue, curveExponential, true).z", pairs(extremes, extremes), 0,
         1},
        {"sky_view", "angleBetween(normalize(vec3(x.x, x.y, 1e-3)), normalize(vec3(x.y, x.x, 1e-3)))",
         pairs({0, 1e-20F, 1, -1, 1e4F}, {0, 1e-20F, 1, -1e4F}), 0, turn},
    };
    for (const auto& function : functions) {
        const auto values = evaluate(context->api(), "lib/" + std::string(function.file) + ".glsl", function.expression, function.inputs);
        for (std::size_t i = 0; i < values.size(); ++i) {
            INFO(function.expression << " of " << function.inputs[i][0] << ", " << function.inputs[i][1] << " is " << values[i]);
            CHECK(std::isfinite(values[i]));
            CHECK(double(values[i]) >= function.least);
            CHECK(double(values[i]) <= function.most);
        }
    }
}
