// From frame to frame while the Sun moves: no pixel's light jumps by more than the frames before and after foretell.

#include "showmysky/photometry.hpp"
#include "sky_for_tests.hpp"
#include <functional>

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

TEST_CASE("a Sun that passes the zenith bends no pixel's light there", "[gl]")
{
    const auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    const Photometer fast(SHOWMYSKY_TEST_MODEL), reference(SHOWMYSKY_TEST_MODEL, Photometer::Method::reference);
    const double viewZenith = 60 * degree, viewAzimuth = 70 * degree;
    // Light of higher orders with the Sun some degrees before the zenith or behind it.
    const auto answers = [&](const Photometer& photometer, double past) {
        const Photometer::View view{0, std::abs(past) * degree, past < 0 ? 0 : 180 * degree, viewZenith, viewAzimuth};
        return photometer.luminance(view, Photometer::multipleScattering).Y;
    };
    const auto drawn = [&](double past) {
        auto settings = scene(0, std::abs(past));
        settings.sun.azimuth = past < 0 ? 0 : 180 * degree;
        settings.layers.singleScattering = settings.layers.zeroOrder = false;
        sky.setSettings(settings);
        sky.draw({Projection::perspective, 1 * degree, viewAzimuth, 90 * degree - viewZenith, 0}, 1, 1);
        return static_cast<double>(sky.pixelLuminance(0, 0).y);
    };
    const std::function<double(double)> readers[] = {[&](double past) { return answers(fast, past); },
                                                     [&](double past) { return answers(reference, past); }, drawn};
    for (const auto& reader : readers) {
        const auto bendAt = [&](double past) {
            return std::log(reader(past - 1)) - 2 * std::log(reader(past)) + std::log(reader(past + 1));
        };
        CAPTURE(&reader - readers, bendAt(-2), bendAt(0), bendAt(2));
        // A grid that went on straight to the zenith has a kink of 1.8e-3 there.
        for (const double past : {-2., 2.})
            CHECK(bendAt(0) == Approx(bendAt(past)).margin(3e-5));
    }
}
