// From frame to frame while the Sun sets: no pixel's light jumps by more than the frames before and after foretell.

#include "sky_for_tests.hpp"

using namespace showmysky;
using namespace showmysky::testing;

namespace {

constexpr double step = 0.05; // degrees
constexpr int width = 8, height = 8;

/// Logarithms of luminance, [frame][pixel]; the Sun sinks from one elevation to another, degrees.
std::vector<std::vector<double>> sunset(Sky& sky, double from, double to, Source source)
{
    const Camera allSky{Projection::fisheye, 176 * degree, 0, 90 * degree, 0};
    std::vector<std::vector<double>> result;
    for (int i = 0; step * i <= from - to + 1e-9; ++i) {
        sky.setSettings(scene(0, 90 - from + step * i, source));
        sky.draw(allSky, width, height);
        std::vector<double> frame;
        for (const auto& pixel : sky.readLuminance())
            if (pixel.y > 0) // the corners are no sky
                frame.push_back(std::log(static_cast<double>(pixel.y)));
        result.push_back(frame);
    }
    return result;
}

/// Largest bend of any pixel's curve: how far a frame is from the middle of its neighbours, as a share of its light.
struct Bend {
    double size = 0;
    std::size_t frame = 0, pixel = 0;
};

Bend largestBend(const std::vector<std::vector<double>>& frames)
{
    Bend worst;
    for (std::size_t i = 1; i + 1 < frames.size(); ++i)
        for (std::size_t k = 0; k < frames[i].size(); ++k) {
            const double bend = std::abs(frames[i][k] - 0.5 * (frames[i - 1][k] + frames[i + 1][k]));
            if (bend > worst.size)
                worst = {bend, i, k};
        }
    return worst;
}

} // namespace

TEST_CASE("sunset: no pixel jumps from one frame to the next", "[gl][slow]")
{
    const auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    struct Case {
        double from, to;
        Source source;
    };
    for (const auto& [from, to, source] : {Case{3, -8, Source::moments}, Case{0.6, -0.6, Source::textures}}) {
        const auto frames = sunset(sky, from, to, source);
        REQUIRE(frames.front().size() >= 40);
        for (const auto& frame : frames)
            REQUIRE(frame.size() == frames.front().size());
        const Bend bend = largestBend(frames);
        CAPTURE(source == Source::moments, bend.size, bend.pixel, from - step * static_cast<double>(bend.frame));
        CHECK(bend.size < 0.005);
        // It gets darker all the time, and a frame by no more than dusk does it: a factor of 2.2 in a degree.
        for (std::size_t i = 1; i < frames.size(); ++i)
            for (std::size_t k = 0; k < frames[i].size(); ++k)
                if (frames[i - 1][k] - frames[i][k] > 0.08 || frames[i - 1][k] - frames[i][k] < -0.01)
                    FAIL_CHECK("pixel " << k << " changes by " << frames[i - 1][k] - frames[i][k] << " at " << from - step * double(i));

        // The bound catches a frame that is one percent off.
        auto flawed = frames;
        for (double& value : flawed[10])
            value += 0.01;
        CHECK(largestBend(flawed).size > 0.0075);
    }
}
